"""Ctrl-C, progress, and threads: nothing here may hold Python's lock for long."""
import os
import signal
import threading
import time

import numpy as np
import penumbra
import pytest
import shapes

LIGHT = penumbra.DiskLight((0, 4, 0), (0, -1, 0), 1.0)
SCENE = penumbra.Scene(*shapes.sphere((0, 1, 0), 0.5))
SCENE.visibility(np.zeros((1, 3)), LIGHT, method="reference", samples=1)  # makes the hierarchy
POINTS = np.random.default_rng(1).uniform((-1, 0, -1), (1, 0.1, 1), (200_000, 3))
# Minutes, where nothing stops it.
LONG = dict(method="reference", samples=4096)


def interrupt_after(seconds, sent):
    """`sent`: the process's own time, of all threads, which other programs do not lengthen."""
    def send():
        time.sleep(seconds)
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=send)
    thread.start()
    return thread


def long_visibility():
    SCENE.visibility(POINTS, LIGHT, **LONG)


def long_solid():
    penumbra.umbra(SCENE, LIGHT, tolerance=0.002)


def long_picture():
    scene = penumbra.Scene(*shapes.sphere((0, 1, 0), 0.5))
    scene.lights, scene.camera = [LIGHT], penumbra.Camera((0, 2, 3), (0, 1, 0))
    penumbra.render(scene, size=(1000, 1000), **LONG)


@pytest.mark.parametrize("call", [long_visibility, long_solid, long_picture])
def test_ctrl_c_stops_a_long_call_within_a_second(call):
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sent = []
    thread = interrupt_after(0.5, sent)
    with pytest.raises(KeyboardInterrupt):
        call()
    took = time.process_time() - sent[0]
    thread.join()
    assert took < len(os.sched_getaffinity(0))


def test_another_handler_of_the_signal_is_run_and_the_call_goes_on():
    calls = []
    before = signal.signal(signal.SIGINT, lambda *_: calls.append(1))
    try:
        thread = interrupt_after(0.05, [])
        SCENE.visibility(POINTS[:20_000], LIGHT, method="reference", samples=256)
        thread.join()
    finally:
        signal.signal(signal.SIGINT, before)
    assert calls == [1]


def test_progress_rises_to_one():
    seen = []
    SCENE.visibility(POINTS[:50_000], LIGHT, method="reference", samples=64, progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == 1.0
    assert all(0.0 <= x <= 1.0 for x in seen)


def test_progress_that_returns_false_cancels():
    with pytest.raises(penumbra.Cancelled):
        SCENE.visibility(POINTS, LIGHT, progress=lambda fraction: False, **LONG)
    assert SCENE.visibility(POINTS[:10], LIGHT).shape == (10,)  # the scene is as it was


def test_what_progress_raises_is_raised():
    def fail(fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        SCENE.visibility(POINTS, LIGHT, progress=fail, **LONG)


def test_python_runs_while_a_call_does():
    """A call that kept the lock would let no other thread run at all; one that releases it lets a loop of sleeps go on."""
    done, beats = threading.Event(), []

    def work():
        SCENE.visibility(POINTS[:100_000], LIGHT, method="reference", samples=256)
        done.set()

    thread = threading.Thread(target=work)
    start = time.monotonic()
    thread.start()
    while not done.wait(0.01):
        beats.append(time.monotonic())
    took = time.monotonic() - start
    thread.join()
    assert took > 0.2, "the call is too short to tell"
    assert len(beats) > 5
    assert max(np.diff([start, *beats])) < 0.5 * took


def test_several_threads_and_scenes_at_once():
    points = POINTS[:5_000]
    expected = SCENE.visibility(points, LIGHT)
    results = {}

    def work(i):
        scene = SCENE if i % 2 else penumbra.Scene(*shapes.sphere((0, 1, 0), 0.5))
        results[i] = [scene.visibility(points, LIGHT) for _ in range(3)]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 6
    for each in results.values():
        for seen in each:
            np.testing.assert_array_equal(seen, expected)


def test_an_object_added_meanwhile_does_not_disturb_a_call():
    scene = penumbra.Scene(*shapes.sphere((0, 1, 0), 0.5))
    results = []
    thread = threading.Thread(target=lambda: results.append(scene.visibility(POINTS[:50_000], LIGHT)))
    thread.start()
    for i in range(20):
        scene.add(*shapes.box((10 + i, 0, 0)))
    thread.join()
    assert results[0].shape == (50_000,)
    assert len(scene) == 21
