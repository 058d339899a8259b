// Where results go: never over an input, through links, under any name that the file system allows; nothing
// half-written is left behind.
#include <gtest/gtest.h>
#include <signal.h>

#include <thread>

#include "apps/cli/study/run_program.h"
#include "apps/common/interrupts.h"
#include "mesh/io/write_file.h"
#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Strings = std::vector<std::string>;

class OutputsTest : public ProgramTest {
 protected:
  OutputsTest() {
    mesh_ = write("t.off", kTetrahedron);
    scene_ = write("scene.json", scene_text("t.off"));
  }
  Strings drawn(const Strings& more) const {
    Strings words = {"render", scene_, "--size", "16x12"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  std::string mesh_, scene_;
};

TEST_F(OutputsTest, NeverReplaceAnInput) {
  std::filesystem::create_symlink("t.off", file("link.off"));
  std::filesystem::create_symlink("scene.json", file("link.json"));
  const Strings image = {"--output", path("a.exr")};
  ASSERT_EQ(run(drawn(image)).code, 0);
  std::filesystem::copy(file("a.exr"), file("a.png"));
  const Strings before = files();
  const std::string mesh = read_text(mesh_), scene = read_text(scene_), picture = read_text(file("a.exr"));
  const std::string ply = write("m.ply", "ply\n");
  for (const Strings& words :
       {Strings{"inspect", mesh_, "--repair", mesh_}, Strings{"inspect", path("link.off"), "--repair", mesh_},
        Strings{"inspect", mesh_, "--repair", path("link.off")}, Strings{"volumes", ply, "--umbra", ply},
        Strings{"volumes", scene_, "--umbra", path("u.ply"), "--report", mesh_},
        Strings{"volumes", scene_, "--check", "--report", path("./link.json")}, drawn({"--stats", scene_}),
        drawn({"--stats", mesh_}), drawn({"--output", path("o.png"), "--stats", path("link.off")}),
        Strings{"compare", path("a.exr"), scene_, "--picture", path("a.png"), "--beside", path("a.png")}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  }
  EXPECT_EQ(read_text(mesh_), mesh);
  EXPECT_EQ(read_text(scene_), scene);
  EXPECT_EQ(read_text(file("a.exr")), picture);
  EXPECT_EQ(read_text(ply), "ply\n");
  Strings after = before;
  after.insert(std::ranges::upper_bound(after, "m.ply"), "m.ply");
  EXPECT_EQ(files(), after);
}

// An OBJ's colors stand in a file of their own.
TEST_F(OutputsTest, NeverReplaceMaterials) {
  write("t.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string obj = write("t.obj", "mtllib t.mtl\nv 0 .1 0\nv 1 .1 0\nv 0 .1 1\nusemtl red\nf 1 2 3\n");
  const std::string scene = write("obj.json", scene_text("t.obj"));
  std::filesystem::create_symlink("t.mtl", file("link.ply"));
  for (const Strings& words :
       {Strings{"render", obj, "--size", "16x12", "--output", path("o.png"), "--stats", path("t.mtl")},
        Strings{"render", scene, "--size", "16x12", "--output", path("o.png"), "--stats", path("t.mtl")},
        Strings{"volumes", scene, "--penumbra", path("link.ply")},
        Strings{"volumes", obj, "--check", "--report", path("t.mtl")},
        Strings{"inspect", obj, "--repair", path("link.ply")}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("would replace the input"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read_text(file("t.mtl")), "newmtl red\nKd 1 0 0\n");
}

TEST_F(OutputsTest, VolumesGoToStandardOutput) {
  ASSERT_EQ(run({"volumes", scene_, "--penumbra", path("p.ply"), "--umbra", path("u.ply")}).code, 0);
  EXPECT_EQ(run({"volumes", scene_, "--penumbra", "-"}).out, read_text(file("p.ply")));
  EXPECT_EQ(run({"volumes", scene_, "--umbra", "-", "--penumbra", path("q.ply")}).out,
            read_text(file("u.ply")));
  EXPECT_EQ(read_text(file("q.ply")), read_text(file("p.ply")));
  ASSERT_EQ(
      run({"volumes", scene_, "--form", "solid", "--tolerance", "20%", "--penumbra", path("s.ply")}).code, 0);
  EXPECT_EQ(run({"volumes", scene_, "--form", "solid", "--tolerance", "20%", "--penumbra", "-"}).out,
            read_text(file("s.ply")));
  const std::string two =
      write("two.json",
            R"({"version":1,"lights":[{"shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":1},
    {"shape":"disk","center":[1,4,0],"normal":[0,-1,0],"radius":1}],"objects":[{"mesh":"t.off"}]})");
  EXPECT_EQ(run({"volumes", two, "--penumbra", "-", "--light", "1"}).code, 0);
  for (const Strings& words :
       {Strings{"volumes", scene_, "--umbra", "-", "--penumbra", "-"},
        Strings{"volumes", scene_, "--umbra", "-", "--report", "-"},
        Strings{"volumes", scene_, "--umbra", "-", "--check"}, Strings{"volumes", two, "--umbra", "-"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(OutputsTest, DoNotReplaceEachOther) {
  std::filesystem::create_symlink("o.png", file("link.png"));
  for (const Strings& words :
       {drawn({"--output", path("o.png"), "--output", path("./o.png")}),
        drawn({"--output", path("o.png"), "--output", path("link.png")}),
        drawn({"--output", path("o.exr"), "--stats", path("o.exr")}),
        Strings{"volumes", scene_, "--umbra", path("u.ply"), "--sheets", path("u.ply")}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("same file"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(files(), (Strings{"link.png", "scene.json", "t.off"}));
}

TEST_F(OutputsTest, FollowLinksAndTakeLongNames) {
  std::filesystem::create_symlink("target.png", file("link.png"));
  const std::string longest = std::string(251, 'n') + ".png";
  EXPECT_EQ(run(drawn({"--output", path("link.png"), "--output", path(longest)})).code, 0);
  EXPECT_EQ(files(), (Strings{"link.png", longest, "scene.json", "t.off", "target.png"}));
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.png")));
  const Outcome outcome = run(drawn({"--output", path("n" + longest)}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("too long"), std::string::npos) << outcome.err;
}

TEST_F(OutputsTest, NamesThatLightsMakeTooLongAreFoundBeforeAnyIsWritten) {
  write("two.json",
        R"({"version":1,"lights":[{"name":"a","shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":1},
    {"name":"much-longer","shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":1}],"objects":[{"mesh":"t.off"}]})");
  const Strings before = files();
  const Outcome outcome = run({"volumes", path("two.json"), "--umbra", path(std::string(249, 'n') + ".ply")});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("too long"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), before);
}

TEST_F(OutputsTest, StandAnywhereOnTheLine) {
  EXPECT_EQ(
      run({"render", "--size", "16x12", "--output", path("a.png"), scene_, "--output", path("b.exr")}).code,
      0);
  EXPECT_EQ(files(), (Strings{"a.png", "b.exr", "scene.json", "t.off"}));
}

TEST_F(OutputsTest, AreNamedByVerbose) {
  const Outcome drawing = run(
      drawn({"--output", path("a.png"), "--output", path("b.exr"), "--stats", path("s.json"), "--verbose"}));
  for (const char* name : {"a.png, ", "b.exr, ", "s.json, "})
    EXPECT_NE(drawing.err.find("wrote " + path(name)), std::string::npos) << drawing.err;
  const Outcome volumes =
      run({"volumes", scene_, "--penumbra", path("p.ply"), "--report", path("r.json"), "--verbose"});
  for (const char* name : {"p.ply, ", "r.json, "})
    EXPECT_NE(volumes.err.find("wrote " + path(name)), std::string::npos) << volumes.err;
  EXPECT_EQ(run(drawn({"--output", path("a.png")})).err, "");
}

TEST_F(OutputsTest, AnInterruptEndsTheProgramThatIsWaitedFor) {
  const std::string script = "touch begun; kill -INT $PPID; sleep 0.5; touch late";
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(file("").c_str()) != 0) _exit(8);
    apps::clean_up_when_interrupted();
    apps::run_program("sh", {"sh", "-c", script}, apps::Stream::kOutput);
    _exit(9);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(1'000));
  EXPECT_TRUE(std::filesystem::exists(file("begun")));
  EXPECT_FALSE(std::filesystem::exists(file("late")));
}

TEST_F(OutputsTest, AnInterruptLeavesNoTemporaryFile) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = fork();
    if (child == 0) {
      apps::clean_up_when_interrupted();
      write_file(file("o.txt"), [signal](std::ostream& out) {
        out << "half" << std::flush;
        raise(signal);
      });
      _exit(9);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
    EXPECT_EQ(files(), (Strings{"scene.json", "t.off"}));
  }
}

TEST_F(OutputsTest, WhatHasNoEffectOrIsEmptyIsSaidInOneLine) {
  struct Case {
    Strings words;
    const char* said;
  };
  const std::string nothing = write("nothing.json", scene_text("t.off", R"(,"casts":false)"));
  const std::string away = write("away.json", R"({"version":1,"lights":[{"shape":"disk","center":[0,4,0],
    "normal":[0,-1,0],"radius":1}],"camera":{"eye":[3,3,4],"target":[6,6,8]},"objects":[{"mesh":"t.off"}]})");
  ASSERT_EQ(run(drawn({"--output", path("a.exr")})).code, 0);
  for (const auto& [words, said] :
       {Case{{"render", away, "--size", "16x12", "--output", path("a.png")}, "the camera sees no surface"},
        Case{drawn({"--output", path("a.exr"), "--samples", "64"}), "--samples has no effect: method auto"},
        Case{drawn({"--output", path("a.exr"), "--exposure", "1"}), "--exposure has no effect"},
        Case{drawn({"--output", path("a.exr"), "--warm-up", "1"}), "--warm-up has no effect"},
        Case{{"volumes", scene_, "--form", "cells", "--penumbra", path("p.ply"), "--merge"},
             "--merge has no effect"},
        Case{{"volumes", scene_, "--penumbra", path("p.ply"), "--level", "0.3"}, "--level has no effect"},
        Case{{"volumes", nothing, "--penumbra", path("p.ply")}, "no object of the scene casts"},
        Case{{"compare", path("a.exr"), path("a.exr"), "--samples", "64"}, "--samples has no effect"},
        Case{{"compare", path("a.exr"), path("a.exr"), "--judge-pixels", "64"},
             "--judge-pixels has no effect"},
        Case{{"compare", path("a.exr"), path("a.exr"), "--beside", path("a.exr")}, "--beside has no effect"},
        Case{{"compare", path("a.exr"), path("a.exr"), "--exposure", "1"}, "--exposure has no effect"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
}

TEST_F(OutputsTest, ScenesAndMeshesComeFromStandardInput) {
  const std::string whole = write("whole.json", scene_text(mesh_));
  EXPECT_EQ(run(drawn({"--output", path("file.exr")})).code, 0);
  EXPECT_EQ(run({"render", "-", "--size", "16x12", "--output", path("scene.exr")}, whole).code, 0);
  EXPECT_EQ(read_exr(file("scene.exr")).channels, read_exr(file("file.exr")).channels);
  EXPECT_EQ(run({"render", mesh_, "--size", "16x12", "--output", path("mesh.exr")}).code, 0);
  EXPECT_EQ(run({"render", "-", "--size", "16x12", "--output", path("in.exr")}, mesh_).code, 0);
  EXPECT_EQ(read_exr(file("in.exr")).channels, read_exr(file("mesh.exr")).channels);
  EXPECT_EQ(run({"inspect", "-", "--json", "--repair", path("r.off")}, mesh_).out,
            run({"inspect", mesh_, "--json", "--repair", path("r.off")}).out);
  EXPECT_EQ(run({"classify", "-"}, whole).out, run({"classify", whole}).out);
  for (const auto& [command, input] :
       {std::pair("inspect", "/dev/null"), std::pair("classify", "/dev/null")}) {
    const Outcome outcome = run({command, "-"}, input);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.error_lines(), 1u);
    EXPECT_NE(outcome.err.find("standard input"), std::string::npos) << outcome.err;
  }
}

TEST_F(OutputsTest, AnEmptyUmbraIsSaid) {
  // Cells make umbras of closed bodies only; and a plate on edge to the light.
  write("small.off", "OFF\n3 1 0\n0 1 0\n1e-3 1 0\n0 1 1e-3\n3 0 1 2\n");
  write("edge.off", "OFF\n3 1 0\n0 1 0\n0 2 0\n0 1 1\n3 0 1 2\n");
  for (const auto& [mesh, form] : {std::pair("small.off", "cells"), std::pair("edge.off", "solid")}) {
    const std::string scene = write("one.json", scene_text(mesh));
    const Outcome outcome =
        run({"volumes", scene, "--form", form, "--umbra", path("u.ply"), "--penumbra", path("p.ply")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("u.ply is empty"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace penumbra::test
