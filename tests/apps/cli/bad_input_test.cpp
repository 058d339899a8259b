// Whatever is wrong with the input: the documented exit code, one line on standard error, and no file left
// behind.
#include <gtest/gtest.h>

#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Strings = std::vector<std::string>;

struct BadMesh {
  const char* name;
  const char* file;
  const char* content;  ///< null: the file does not exist
};

void PrintTo(const BadMesh& bad, std::ostream* out) {
  *out << bad.name;
}

const BadMesh kBadMeshes[] = {
    {"Missing", "m.ply", nullptr},
    {"Empty", "m.ply", ""},
    {"NoMesh", "m.ply", "hello\n"},
    {"UnknownExtension", "m.xyz", "hello\n"},
    {"TruncatedOff", "m.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n"},
    {"TruncatedHeader", "m.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"},
    {"TruncatedBinary", "m.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
     "float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\nabcdefgh"},
    {"CountsLargerThanFile", "m.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
     "property float z\nelement face 4000000000\nproperty list uchar int "
     "vertex_indices\nend_header\nabcdefgh"},
    {"CountsLargerThanOff", "m.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"},
    {"NegativeCounts", "m.off", "OFF\n-3 -1 0\n0 0 0\n"},
    {"NaN", "m.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"Infinite", "m.off", "OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"Overflow", "m.off", "OFF\n3 1 0\n0 0 1e999\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"IndexOutOfRange", "m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
    {"NoFaces", "m.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"},
};

class BadMeshTest : public ProgramTest, public testing::WithParamInterface<BadMesh> {
 protected:
  void SetUp() override {
    if (GetParam().content) write(GetParam().file, GetParam().content);
    write("scene.json", scene_text(GetParam().file));
    before_ = files();
  }
  void expect_refused(const Outcome& outcome) const {
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("penumbra: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().file), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before_);
  }

 private:
  Strings before_;
};

TEST_P(BadMeshTest, Inspect) {
  expect_refused(run({"inspect", path(GetParam().file)}));
}
TEST_P(BadMeshTest, RenderBareMesh) {
  expect_refused(run({"render", path(GetParam().file), "--output", path("o.png")}));
}
TEST_P(BadMeshTest, VolumesOfScene) {
  expect_refused(
      run({"volumes", path("scene.json"), "--penumbra", path("p.ply"), "--report", path("r.json")}));
}

INSTANTIATE_TEST_SUITE_P(All, BadMeshTest, testing::ValuesIn(kBadMeshes),
                         [](const auto& bad) { return std::string(bad.param.name); });

struct BadScene {
  const char* name;
  std::string content;
  const char* expected;  ///< what the message must name
};

void PrintTo(const BadScene& bad, std::ostream* out) {
  *out << bad.name;
}

const std::string kLight = R"({"shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":0.5})";
const std::string kObjects = R"("objects":[{"mesh":"t.off"}])";

std::string with_lights(const std::string& lights) {
  return R"({"version":1,"lights":)" + lights + "," + kObjects + "}";
}
std::string with_camera(const std::string& camera) {
  return R"({"version":1,"camera":)" + camera + R"(,"lights":[)" + kLight + "]," + kObjects + "}";
}

const BadScene kBadScenes[] = {
    {"Empty", "", "empty"},
    {"Truncated", R"({"version":1,"lights":[)", "line 1"},
    {"Comment", "{} // no", "line 1, column 4"},
    {"NoObject", "[]", "top level"},
    {"DepthBomb", std::string(200'000, '['), "nests"},
    {"DepthBombOfObjects",
     [] {
       std::string text;
       for (int i = 0; i < 100'000; ++i) text += R"({"x-":)";
       return text;
     }(),
     "nests"},
    {"NumberOverflow", R"({"version":1e999})", "1e999"},
    {"NoVersion", R"({"lights":[)" + kLight + "]," + kObjects + "}", "version"},
    {"OtherVersion", R"({"version":2,"lights":[)" + kLight + "]," + kObjects + "}", "/version"},
    {"NoLights", with_lights("[]"), "/lights"},
    {"TwoLightsOfOneName",
     with_lights(R"([{"name":"a","shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":1},
                    {"name":"a","shape":"disk","center":[0,5,0],"normal":[0,-1,0],"radius":1}])"),
     "/lights/1: is the second light called \"a\""},
    {"NameOfALight",
     with_lights(R"([{"name":"a b","shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":1}])"),
     "/lights/0/name"},
    {"ShapeNearAnother", with_lights(R"([{"shape":"disc","center":[0,4,0],"normal":[0,-1,0],"radius":1}])"),
     "(did you mean disk?)"},
    {"SphereLight", with_lights(R"([{"shape":"sphere","center":[0,4,0],"normal":[0,-1,0],"radius":1}])"),
     "/lights/0/shape"},
    {"RectangleWithoutTangent",
     with_lights(R"([{"shape":"rectangle","center":[0,4,0],"normal":[0,-1,0],"half_extents":[1,1]}])"),
     "/lights/0: \"tangent\" is missing"},
    {"NegativeRadius", scene_text("t.off", "", R"("normal":[0,-1,0],"radius":-0.5)"), "/lights/0/radius"},
    {"ZeroNormal", scene_text("t.off", "", R"("normal":[0,0,0],"radius":0.5)"), "/lights/0/normal"},
    {"NegativeRadiance", scene_text("t.off", "", R"("normal":[0,-1,0],"radius":1,"radiance":[1,-1,1])"),
     "/lights/0/radiance"},
    {"ShortVector", scene_text("t.off", "", R"("normal":[0,-1],"radius":0.5)"), "/lights/0/normal"},
    {"TextForNumber", scene_text("t.off", "", R"("normal":[0,-1,0],"radius":"1")"), "/lights/0/radius"},
    {"FieldOfView", with_camera(R"({"eye":[1,1,1],"target":[0,0,0],"fov_y_degrees":180})"),
     "/camera/fov_y_degrees"},
    {"EyeIsTarget", with_camera(R"({"eye":[1,1,1],"target":[1,1,1]})"), "/camera/target"},
    {"UpParallel", with_camera(R"({"eye":[0,5,0],"target":[0,0,0],"up":[0,2,0]})"), "/camera/up"},
    {"NoObjects", R"({"version":1,"lights":[)" + kLight + R"(],"objects":[]})", "/objects"},
    {"NoMeshKey", R"({"version":1,"lights":[)" + kLight + R"(],"objects":[{}]})", "/objects/0"},
    {"SingularMatrix", scene_text("t.off", R"(,"matrix":[1,0,0,0, 0,0,0,0, 0,0,1,0, 0,0,0,1])"),
     "/objects/0/matrix"},
    {"SingularDependentColumns", scene_text("t.off", R"(,"matrix":[1,2,3,0, 4,5,6,0, 7,8,9,0, 0,0,0,1])"),
     "/objects/0/matrix"},
    {"ProjectiveMatrix", scene_text("t.off", R"(,"matrix":[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
     "/objects/0/matrix"},
    {"MatrixAndScale", scene_text("t.off", R"(,"scale":2,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
     "/objects/0"},
    {"ZeroScale", scene_text("t.off", R"(,"scale":[1,0,1])"), "/objects/0/scale"},
    {"ZeroQuaternion", scene_text("t.off", R"(,"rotation":[0,0,0,0])"), "/objects/0/rotation"},
    {"AlbedoAboveOne", scene_text("t.off", R"(,"albedo":[2,0,0])"), "/objects/0/albedo"},
    {"CastsIsNumber", scene_text("t.off", R"(,"casts":1)"), "/objects/0/casts"},
    {"TransformOverflows", scene_text("t.off", R"(,"scale":1e308,"translation":[1.7e308,1.7e308,0])"),
     "/objects/0"},
    {"HugeScale", scene_text("t.off", R"(,"scale":1e200)"), "/objects/0/scale: is 1e+200, beyond 1e+100"},
    {"FarObject", scene_text("t.off", R"(},{"mesh":"t.off","casts":false,"translation":[0,1e20,0])"),
     "/objects/1: the object is farther"},
    {"FarCamera",
     R"({"version":1,"lights":[)" + kLight +
         R"(],"camera":{"eye":[1e20,3,5],"target":[0,0,0]},"objects":[{"mesh":"t.off"}]})",
     "/camera/eye: the camera is farther"},
};

class BadSceneTest : public ProgramTest, public testing::WithParamInterface<BadScene> {};

TEST_P(BadSceneTest, IsRefusedByEveryCommand) {
  write("t.off", kTetrahedron);
  const std::string scene = write("scene.json", GetParam().content);
  const Strings before = files();
  for (const Strings& command :
       {Strings{"classify", scene}, Strings{"render", scene, "--output", path("o.exr")},
        Strings{"volumes", scene, "--umbra", path("u.ply")}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find("scene.json"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().expected), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), before);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadSceneTest, testing::ValuesIn(kBadScenes),
                         [](const auto& bad) { return std::string(bad.param.name); });

struct BadUsage {
  const char* name;
  Strings arguments;  ///< SCENE stands for a good scene
  int code = 2;
  const char* expected = "";
};

void PrintTo(const BadUsage& bad, std::ostream* out) {
  *out << bad.name;
}

const BadUsage kBadUsages[] = {
    {"NoCommand", {}, 2, "subcommand"},
    {"UnknownCommand", {"rendr", "SCENE"}, 2, "unknown command 'rendr' (did you mean render?)"},
    {"UnknownCommandBehindOption", {"--threads"}, 2, "unknown option --threads"},
    {"UnknownOptionNearAnother", {"render", "SCENE", "--outptu", "o.png"}, 2, "(did you mean --output?)"},
    {"UnknownOptionInPlaceOfAll",
     {"render", "--ouput=o.png"},
     2,
     "unknown option --ouput (did you mean --output?)"},
    {"PartOfAnOption",
     {"render", "SCENE", "--expo", "1"},
     2,
     "unknown option --expo (did you mean --exposure?)"},
    {"SuperfluousArgument", {"classify", "SCENE", "more"}, 2, "unexpected argument 'more'"},
    {"MethodNearAnother",
     {"render", "SCENE", "--output", "o.png", "--method", "silhouete"},
     2,
     "(did you mean silhouette?)"},
    {"WordNearAnother",
     {"render", "SCENE", "--output", "o.png", "--combine", "prodcut"},
     2,
     "(did you mean product?)"},
    {"FormNearAnother", {"volumes", "SCENE", "--check", "--form", "sold"}, 2, "(did you mean solid?)"},
    {"JudgeNearAnother", {"compare", "o.exr", "SCENE", "--judge", "doubel"}, 2, "(did you mean double?)"},
    {"LightNearAnother", {"volumes", "NAMED", "--check", "--light", "wimdow"}, 2, "(did you mean window?)"},
    {"SeedOverflows",
     {"render", "SCENE", "--output", "o.png", "--seed", "18446744073709551616"},
     2,
     "64 bits"},
    {"SeedNegative", {"render", "SCENE", "--output", "o.png", "--seed", "-1"}, 2, "64 bits"},
    {"UnknownOption", {"render", "SCENE", "--color", "red"}, 2, "--color"},
    {"NoScene", {"render", "--output", "o.png"}, 2, "SCENE"},
    {"NothingToDo", {"render", "SCENE"}, 2, "--output"},
    {"NoVolumesAsked", {"volumes", "SCENE"}, 2, "--umbra"},
    {"UnknownMethod", {"render", "SCENE", "--output", "o.png", "--method", "magic"}, 2, "magic"},
    {"UnknownBackend", {"render", "SCENE", "--output", "o.png", "--backend", "glut"}, 2, "glut"},
    {"SizeZero", {"render", "SCENE", "--output", "o.png", "--size", "0x0"}, 2, "0x0"},
    {"SizeNegative", {"render", "SCENE", "--output", "o.png", "--size", "-4x4"}, 2, "-4x4"},
    {"SizeJunk", {"render", "SCENE", "--output", "o.png", "--size", "10x10px"}, 2, "10x10px"},
    {"SizeOneNumber", {"render", "SCENE", "--output", "o.png", "--size", "640"}, 2, "640"},
    {"SizeHuge", {"render", "SCENE", "--output", "o.png", "--size", "99999x2"}, 2, "16384"},
    {"SizeOverflow", {"render", "SCENE", "--output", "o.png", "--size", "99999999999x2"}, 2, "99999999999"},
    {"NoSamples", {"render", "SCENE", "--output", "o.png", "--samples", "0"}, 2, "--samples"},
    {"ThreadsNegative", {"render", "SCENE", "--output", "o.png", "--threads", "-1"}, 2, "--threads"},
    {"ExposureNaN", {"render", "SCENE", "--output", "o.png", "--exposure", "nan"}, 2, "--exposure"},
    {"UnknownExtension", {"render", "SCENE", "--output", "o.bmp"}, 2, ".png"},
    {"NoExtension", {"render", "SCENE", "--output", "o"}, 2, ".png"},
    {"ProbeOutside", {"render", "SCENE", "--probe", "640,0"}, 2, "640,0"},
    {"ProbeJunk", {"render", "SCENE", "--probe", "middle"}, 2, "middle"},
    {"TwoResultsOnStandardOutput",
     {"render", "SCENE", "--output", "-", "--stats", "-"},
     2,
     "standard output"},
    {"VolumesExtension", {"volumes", "SCENE", "--umbra", "u.stl"}, 2, ".ply"},
    {"VolumesSameFile", {"volumes", "SCENE", "--umbra", "u.ply", "--penumbra", "u.ply"}, 2, "same file"},
    {"ConeSegments", {"volumes", "SCENE", "--umbra", "u.ply", "--cone-segments", "2"}, 2, "--cone-segments"},
    {"CompareNoImage", {"compare", "SCENE", "SCENE"}, 2, ".exr"},
    {"CompareMissingImage", {"compare", "missing.exr", "SCENE"}, 2, "missing.exr"},
    {"FolderMissing", {"render", "SCENE", "--output", "no/such/folder/o.png"}, 1, "no/such/folder"},
    {"FolderIsFile", {"volumes", "SCENE", "--umbra", "SCENE/u.ply"}, 1, "u.ply"},
    {"StatsFolderMissing", {"render", "SCENE", "--output", "o.png", "--stats", "no/s.json"}, 1, "no/s.json"},
    {"NotStrictlyKnown", {"classify", "ODD", "--strict"}, 3, "/objects/0/color"},
};

class BadUsageTest : public ProgramTest, public testing::WithParamInterface<BadUsage> {};

TEST_P(BadUsageTest, IsRefused) {
  write("t.off", kTetrahedron);
  const std::string scene = write("scene.json", scene_text("t.off"));
  const std::string odd = write("odd.json", scene_text("t.off", R"(,"color":[1,0,0])"));
  const std::string named =
      write("named.json", scene_text("t.off", "", R"("normal":[0,-1,0],"radius":1,"name":"window")"));
  const Strings before = files();
  Strings arguments = GetParam().arguments;
  for (std::string& each : arguments) {
    if (each.starts_with("SCENE"))
      each = scene + each.substr(5);
    else if (each == "ODD")
      each = odd;
    else if (each == "NAMED")
      each = named;
    else if (each.find('.') != std::string::npos && each.front() != '-')
      each = path(each);
  }
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, GetParam().code) << outcome.err;
  EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("penumbra: ")) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().expected), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files(), before);
}

INSTANTIATE_TEST_SUITE_P(All, BadUsageTest, testing::ValuesIn(kBadUsages),
                         [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace penumbra::test
