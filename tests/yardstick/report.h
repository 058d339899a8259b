// What the yardstick finds: one line a case, and whether it is right.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::yardstick {

/// Cases that have to be right, as patterns of the shell over the names of findings. What is not listed is
/// measured and printed all the same.
const std::vector<std::string>& required();

class Report {
 public:
  /// Only what one of the patterns matches is wanted; all where there is none.
  explicit Report(std::vector<std::string> patterns,
                  std::vector<std::string> required = yardstick::required())
      : patterns_(std::move(patterns)), required_(std::move(required)) {}

  /// `name` is a path, PART, PART/CASE or PART/CASE/METHOD. A pattern matches it where words at the same
  /// place match.
  bool wants(const std::string& name) const;
  /// Prints the line at once.
  void add(const std::string& name, bool right, const std::string& figures);
  /// Calls `judge`; what it throws is a finding that is wrong.
  template <class Judge>
  void attempt(const std::string& name, const Judge& judge) {
    try {
      judge();
    } catch (const std::exception& e) {
      add(name, false, e.what());
    }
  }
  /// Prints how many cases of each part and method are right. 0, or 1 where one that is required is wrong or
  /// was not looked at although it was wanted.
  int conclude() const;

 private:
  struct Finding {
    std::string name;
    bool right;
  };
  std::vector<std::string> patterns_, required_;
  std::vector<Finding> findings_;
};

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace penumbra::yardstick
