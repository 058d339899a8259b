// Options as data: each schema alone, and those of all methods.
#include "penumbra/render/method_option.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"

namespace penumbra {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

OptionSchema schema(OptionDomain domain, OptionValue usual, std::string unit = {}) {
  return {.name = "some-option",
          .domain = std::move(domain),
          .usual = std::move(usual),
          .unit = std::move(unit),
          .help = "what it decides"};
}
OptionSchema rows() {
  return schema(IntegerRange{4, 1024}, std::uint64_t{64}, "rows");
}
OptionSchema size_or_zero() {
  return schema(IntegerRange{16, 8192, {0}}, std::uint64_t{0}, "texels");
}
OptionSchema slices() {
  return schema(IntegerChoice{{4, 8, 12, 16}}, std::uint64_t{16});
}
OptionSchema offset() {
  return schema(RealRange{0.0, kInfinity, false, {"auto", "orthographic"}}, std::string("auto"));
}
OptionSchema tolerance() {
  return schema(RealRange{0.0, 0.1}, 0.004, "light radii");
}
OptionSchema word() {
  return schema(WordChoice{{"edge", "distances"}}, std::string("edge"));
}

std::string refusal(const OptionSchema& option, std::string_view text) {
  try {
    option.parse(text);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "not refused";
}

TEST(OptionSchema, SaysWhatIsAllowed) {
  EXPECT_EQ(rows().allowed(), "4 to 1024 rows");
  EXPECT_EQ(size_or_zero().allowed(), "0 or 16 to 8192 texels");
  EXPECT_EQ(slices().allowed(), "4, 8, 12 or 16");
  EXPECT_EQ(offset().allowed(), "auto, orthographic or a number above 0");
  EXPECT_EQ(tolerance().allowed(), "0 to 0.1 light radii");
  EXPECT_EQ(word().allowed(), "edge or distances");
  EXPECT_EQ(schema(IntegerRange{0, kLargest}, std::uint64_t{1}).allowed(),
            "a whole number of at most 64 bits");
}

TEST(OptionSchema, Parses) {
  EXPECT_EQ(rows().parse("4"), OptionValue(std::uint64_t{4}));
  EXPECT_EQ(rows().parse("1024"), OptionValue(std::uint64_t{1024}));
  EXPECT_EQ(size_or_zero().parse("0"), OptionValue(std::uint64_t{0}));
  EXPECT_EQ(offset().parse("orthographic"), OptionValue("orthographic"));
  EXPECT_EQ(offset().parse("2.5"), OptionValue(2.5));
  EXPECT_EQ(tolerance().parse("0"), OptionValue(0.0));
  EXPECT_EQ(tolerance().parse("1e-3"), OptionValue(1e-3));
  EXPECT_EQ(word().parse("distances"), OptionValue("distances"));
}

TEST(OptionSchema, RefusesEverythingElse) {
  for (const char* text :
       {"", " ", "3", "1025", "-8", "8.0", "8 ", " 8", "8x", "0x8", "eight", "1e2", "18446744073709551616"})
    EXPECT_EQ(refusal(rows(), text),
              "option some-option: '" + std::string(text) + "' is not allowed; give 4 to 1024 rows");
  for (const char* text : {"1", "15", "8193"})
    EXPECT_NE(refusal(size_or_zero(), text), "not refused") << text;
  for (const char* text : {"5", "0", "20"}) EXPECT_NE(refusal(slices(), text), "not refused") << text;
  for (const char* text : {"0", "-1", "nan", "inf", "Auto", ""})
    EXPECT_NE(refusal(offset(), text), "not refused") << text;
  for (const char* text : {"-1e-9", "0.1000001", "nan", "auto", "0,05"})
    EXPECT_NE(refusal(tolerance(), text), "not refused") << text;
  for (const char* text : {"", "Edge", "edge ", "0"}) EXPECT_NE(refusal(word(), text), "not refused") << text;
}

TEST(OptionSchema, RefusesValuesOfAnotherType) {
  EXPECT_THROW(rows().require_allowed(64.0), UsageError);
  EXPECT_THROW(rows().require_allowed("64"), UsageError);
  EXPECT_THROW(tolerance().require_allowed(std::uint64_t{0}), UsageError);
  EXPECT_THROW(word().require_allowed(1.0), UsageError);
}

TEST(Completed, HasEveryOptionOfTheSchemaAndNoOther) {
  std::vector<OptionSchema> all{rows(), tolerance()};
  all[1].name = "another";
  const OptionValues values = completed(all, {{"another", 0.05}, {"of-another-method", "word"}});
  EXPECT_EQ(values, (OptionValues{{"some-option", std::uint64_t{64}}, {"another", 0.05}}));
  EXPECT_EQ(integer_of(values, "some-option"), 64u);
  EXPECT_EQ(real_of(values, "another"), 0.05);
  EXPECT_THROW(completed(all, {{"another", 0.2}}), UsageError);
  EXPECT_THROW(completed(all, {{"another", "word"}}), UsageError);
}

/// Values at the limits of a domain, and values just beyond them.
struct Limits {
  std::vector<OptionValue> inside, outside;
};
struct LimitsOf {
  Limits operator()(const IntegerRange& d) const {
    Limits out{{d.low, d.high}, {}};
    for (const std::uint64_t value : d.also) out.inside.emplace_back(value);
    const auto is_also = [&](std::uint64_t n) {
      return std::find(d.also.begin(), d.also.end(), n) != d.also.end();
    };
    if (d.low > 0 && !is_also(d.low - 1)) out.outside.emplace_back(d.low - 1);
    if (d.high < kLargest) out.outside.emplace_back(d.high + 1);
    return out;
  }
  Limits operator()(const IntegerChoice& d) const {
    Limits out;
    for (const std::uint64_t value : d.values)
      out.inside.emplace_back(value), out.outside.emplace_back(value + 1);
    return out;
  }
  Limits operator()(const RealRange& d) const {
    Limits out{{std::nextafter(d.low, kInfinity)},
               {std::nextafter(d.low, -kInfinity), std::nan(""), kInfinity, -kInfinity, "no such word"}};
    (d.low_included ? out.inside : out.outside).emplace_back(d.low);
    if (std::isfinite(d.high))
      out.inside.emplace_back(d.high), out.outside.emplace_back(std::nextafter(d.high, kInfinity));
    for (const std::string& word : d.words) out.inside.emplace_back(word);
    return out;
  }
  Limits operator()(const WordChoice& d) const {
    Limits out{{}, {"no such word", "", 1.0}};
    for (const std::string& word : d.words) out.inside.emplace_back(word);
    return out;
  }
};

TEST(MethodOptions, KeepTheirDomains) {
  register_drawing_methods();
  std::size_t options = 0, refused = 0;
  for (const MethodInfo& method : methods())
    for (const OptionSchema& option : method.options) {
      const std::string what = method.name + ", " + option.name + ", ";
      ++options;
      EXPECT_FALSE(option.help.empty()) << what;
      EXPECT_NO_THROW(option.require_allowed(option.usual)) << what << "the default";
      if (option.draft) {
        EXPECT_NO_THROW(option.require_allowed(*option.draft)) << what << "the draft";
      }
      const Limits limits = std::visit(LimitsOf(), option.domain);
      for (const OptionValue& value : limits.inside) {
        EXPECT_NO_THROW(option.require_allowed(value)) << what << to_text(value);
        EXPECT_EQ(option.parse(to_text(value)), value) << what << to_text(value);
      }
      for (const OptionValue& value : limits.outside) {
        EXPECT_THROW(option.require_allowed(value), UsageError) << what << to_text(value);
        EXPECT_THROW(completed(method.options, {{option.name, value}}), UsageError) << what << to_text(value);
        ++refused;
      }
      EXPECT_EQ(option.parse(to_text(option.usual)), option.usual) << what << "the default";
    }
  EXPECT_GE(options, 20u);
  EXPECT_GE(refused, 2 * options);
}

TEST(MethodOptions, OfOneNameAreOneOption) {
  register_drawing_methods();
  for (const MethodInfo& method : methods())
    for (const OptionSchema& option : method.options) {
      const std::vector<OptionSchema> all = all_options();
      EXPECT_EQ(std::count(all.begin(), all.end(), option), 1) << method.name << ", " << option.name;
    }
}

TEST(RegisterMethod, RefusesNamesThatStandForSomethingElse) {
  const std::size_t before = methods().size();
  MethodInfo taken = method_named("reference");
  EXPECT_THROW(register_method(taken), UsageError) << "the method's name";
  const MethodInfo fresh = [&] {
    MethodInfo info = taken;
    info.name = "reference-of-another-kind";
    return info;
  }();
  for (const auto& change : std::vector<std::function<void(OptionSchema&)>>{
           [](OptionSchema& o) {
             o.domain = IntegerRange{1, 2};
           },
           [](OptionSchema& o) { o.usual = std::uint64_t{7}; }, [](OptionSchema& o) { o.unit = "cups"; },
           [](OptionSchema& o) { o.help = "Something else"; }}) {
    MethodInfo other = fresh;
    change(other.options.front());
    EXPECT_THROW(register_method(other), UsageError) << other.options.front().help;
  }
  EXPECT_EQ(methods().size(), before) << "what is refused is not there";
  EXPECT_THROW(method_named(fresh.name), UsageError);
}

TEST(MethodNamed, ListsTheMethodsWhereThereIsNone) {
  try {
    method_named("Silhouette");
    FAIL();
  } catch (const UsageError& e) {
    for (const MethodInfo& method : methods())
      EXPECT_NE(std::string(e.what()).find(method.name), std::string::npos) << e.what();
  }
  EXPECT_EQ(method_named(kDefaultMethod).name, kDefaultMethod);
}

}  // namespace
}  // namespace penumbra
