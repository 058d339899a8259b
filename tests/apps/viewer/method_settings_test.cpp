// The viewer's settings come from the registry, those of a method from outside too.
#include "apps/viewer/state/method_settings.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "tests/apps/toy_method.h"

namespace penumbra::viewer {
namespace {

class MethodSettings : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    test::require_toy();
    register_drawing_methods();
  }
};

TEST_F(MethodSettings, OfAMethodFromOutsideAreSet) {
  RenderOptions options;
  options.method = "toy";
  EXPECT_EQ(settings_arguments(options), "");
  set(options, "toy-share", "0.75");
  EXPECT_EQ(value_of(options, method_named("toy").options.front()), "0.75");
  EXPECT_EQ(settings_arguments(options), " --toy-share 0.75");
  for (const char* bad : {"1.5", "", "much"}) {
    EXPECT_THROW(set(options, "toy-share", bad), UsageError) << bad;
    EXPECT_EQ(settings_arguments(options), " --toy-share 0.75") << "as it was";
  }
  set(options, "toy-share", "0.25");
  EXPECT_EQ(settings_arguments(options), "") << "the default again";
}

TEST_F(MethodSettings, OfEveryMethodStartAtTheirDefaults) {
  for (const MethodInfo& method : methods()) {
    RenderOptions options;
    options.method = method.name;
    for (const OptionSchema& option : method.options) {
      EXPECT_EQ(value_of(options, option), to_text(option.usual)) << method.name << ", " << option.name;
      for (const std::string& choice : choices_of(option)) {
        set(options, option.name, choice);
        EXPECT_EQ(value_of(options, option), choice) << method.name << ", " << option.name;
      }
      set(options, option.name, to_text(option.usual));
    }
    EXPECT_EQ(settings_arguments(options), "") << method.name;
  }
}

TEST_F(MethodSettings, OfNoMethodAreRefused) {
  RenderOptions options;
  EXPECT_THROW(set(options, "no-such-option", "1"), UsageError);
  EXPECT_TRUE(options.options.empty());
}

TEST_F(MethodSettings, AreChosenFromListsWhereTheyAreFew) {
  const auto choices = [](const char* method, const std::string& name) {
    for (const OptionSchema& option : method_named(method).options)
      if (option.name == name) return choices_of(option);
    return std::vector<std::string>{"no such option"};
  };
  EXPECT_EQ(choices("occlusion-textures", "slices"), (std::vector<std::string>{"4", "8", "12", "16"}));
  EXPECT_EQ(choices("dbuffer", "dbuffer"), (std::vector<std::string>{"edge", "distances"}));
  EXPECT_TRUE(choices("reference", "samples").empty()) << "to be typed";
  EXPECT_TRUE(choices("toy", "toy-share").empty()) << "to be typed";
}

}  // namespace
}  // namespace penumbra::viewer
