"""Tables of frames that follow each other while a light moves. Each takes one part and returns markdown."""
from figures import scenes_of
from table_text import error, markdown, number


def kept_frames(part):
    rows = []
    for scene in scenes_of(part, "/silhouette/kept/render"):
        ratio = part.figures[f"{scene}/silhouette/kept : anew"]
        rows.append([scene, number(part.median(f"{scene}/silhouette/anew/render")),
                     number(part.median(f"{scene}/silhouette/kept/render")),
                     f"{ratio['median']:.2f} ({ratio['low']:.2f} to {ratio['high']:.2f})"])
    return markdown(["scene", "made anew, ms", "kept, ms", "kept : anew"], rows)


def pops(part):
    """Rows of each method, and of what it did where its plan changed."""
    rows = []
    for scene in scenes_of(part, "/auto/plans that changed"):
        for method in ("silhouette", "auto", "auto, plan changes"):
            path = f"{scene}/{method}"
            if part.median(path + "/apart") is None:
                continue
            frames = part.figures[path + "/apart"]["runs"]
            rows.append([scene, "`auto` where its plan changes" if "," in method else f"`{method}`", str(frames),
                         *(error(part.median(f"{path}/{name}")) for name in
                           ("change", "change of rays", "apart", "apart, most of all frames", "apart, most of all pixels"))])
    return markdown(["scene", "method", "frames", "change", "change of rays", "apart", "most of a frame", "most of a pixel"], rows)


def viewer_pace(part):
    rows = []
    for path in part.names_before("/pictures a second"):
        scene, size = path.split("/")
        shares = 100.0 * part.median(f"{path}/full size")
        rows.append([scene, size.replace("x", " × "), number(part.median(f"{path}/pictures a second")), f"{shares:.0f}%",
                     number(part.median(f"{path}/a picture")), number(part.median(f"{path}/processor"))])
    return markdown(["scene", "size", "pictures a second", "at full size", "a picture, ms", "processor, ms a picture"], rows)
