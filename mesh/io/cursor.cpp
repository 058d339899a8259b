#include "mesh/io/cursor.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

bool is_newline(char c) {
  return c == '\n' || c == '\r';
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/// from_chars says "out of range" for 1e999 and 1e-999 alike: the place of the first digit tells which.
double out_of_range_value(std::string_view token) {
  const bool negative = token.starts_with('-');
  const std::size_t exponent_at = std::min(token.find_first_of("eE"), token.size());
  const std::string_view digits = token.substr(0, exponent_at);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = std::min(digits.find_first_of("123456789"), digits.size());
  std::string_view exponent_text = token.substr(std::min(exponent_at + 1, token.size()));
  exponent_text.remove_prefix(exponent_text.starts_with('+') ? 1 : 0);
  std::int64_t exponent = 0;
  const auto parsed = std::from_chars(exponent_text.begin(), exponent_text.end(), exponent);
  if (parsed.ec == std::errc::result_out_of_range) {
    exponent = exponent_text.starts_with('-') ? -(std::int64_t{1} << 62) : (std::int64_t{1} << 62);
  }
  const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  const double size = exponent + place > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -size : size;
}

/// -1.#IND, 1.#QNAN00 and the like.
bool parse_not_finite(std::string_view token, double& value) {
  const double sign = token.starts_with('-') ? -1.0 : 1.0;
  token.remove_prefix(token.find('#') + 1);
  token = token.substr(0, token.find_last_not_of('0') + 1);
  if (token == "INF") {
    value = sign * std::numeric_limits<double>::infinity();
  } else if (token == "IND" || token == "QNAN" || token == "SNAN") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else {
    return false;
  }
  return true;
}

std::string_view without_plus(std::string_view token) {
  const bool plus = token.size() > 1 && token[0] == '+' && token[1] != '-';
  return plus ? token.substr(1) : token;
}

}  // namespace

void fail_reading(const std::string& name, const std::string& where, const std::string& what,
                  const std::string& advice) {
  std::string message = name;
  std::replace_if(
      message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  throw MeshError(
      message.append(where.empty() ? "" : ": ").append(where).append(": ").append(what).append("; ") +
      advice);
}

std::string quote(std::string_view text) {
  constexpr std::size_t kMost = 32;
  std::string quoted = "'";
  for (const char c : text.substr(0, kMost)) {
    quoted += c >= ' ' && c <= '~' ? c : '?';
  }
  return quoted.append(text.size() > kMost ? "...'" : "'");
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string_view without_mark(std::string_view text) {
  return text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
}

bool parse_number(std::string_view token, double& value) {
  token = without_plus(token);
  if (token.size() >= 5 && token.substr(token.starts_with('-')).starts_with("1.#"))
    return parse_not_finite(token, value);
  const auto [end, error] = std::from_chars(token.begin(), token.end(), value);
  if (error == std::errc::invalid_argument || end != token.end()) {
    return false;
  }
  if (error == std::errc::result_out_of_range) {
    value = out_of_range_value(token);
  }
  return true;
}

bool parse_number(std::string_view token, std::int64_t& value) {
  token = without_plus(token);
  const auto [end, error] = std::from_chars(token.begin(), token.end(), value);
  return error == std::errc() && end == token.end();
}

TextCursor::TextCursor(std::string_view text, std::string name, char comment, bool joins_lines)
    : text_(text), name_(std::move(name)), comment_(comment), joins_lines_(joins_lines) {
  at_ = text_.size() - without_mark(text_).size();
}

void TextCursor::skip_blanks() {
  while (!at_end()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (comment_ != 0 && c == comment_) {
      at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
    } else if (joins_lines_ && c == '\\' && (at_ + 1 == text_.size() || is_newline(text_[at_ + 1]))) {
      ++at_;
      skip_line();
    } else {
      return;
    }
  }
}

std::string_view TextCursor::token_of_line() {
  skip_blanks();
  const std::size_t begin = at_;
  while (!at_end() && !is_blank(text_[at_]) && !is_newline(text_[at_]) && !begins_comment(begin)) {
    if (joins_lines_ && text_[at_] == '\\' && at_ > begin && at_ + 1 < text_.size() &&
        is_newline(text_[at_ + 1])) {
      break;
    }
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

/// The # of -1.#IND, 1.#QNAN and 1.#INF begins none.
bool TextCursor::begins_comment(std::size_t token) const {
  if (comment_ == 0 || text_[at_] != comment_) return false;
  const std::string_view before = text_.substr(token, at_ - token);
  const std::string_view behind = text_.substr(at_ + 1, 1);
  return !(before.ends_with("1.") && behind.find_first_of("IQS") == 0);
}

std::string TextCursor::rest_of_line() {
  std::string rest;
  for (std::string_view token = token_of_line(); !token.empty(); token = token_of_line())
    rest.append(rest.empty() ? "" : " ").append(token);
  return rest;
}

std::string TextCursor::name_of_line() {
  const char comment = std::exchange(comment_, '\0');
  std::string name = rest_of_line();
  comment_ = comment;
  const std::size_t end = comment ? name.find(std::string{' ', comment, ' '}) : std::string::npos;
  return name.substr(0, end);
}

std::string_view TextCursor::token() {
  for (;;) {
    const std::string_view found = token_of_line();
    if (!found.empty() || at_end()) {
      return found;
    }
    skip_line();
  }
}

void TextCursor::skip_line() {
  at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  if (!at_end()) {
    at_ += text_.substr(at_).starts_with("\r\n") ? 2 : 1;
    ++line_;
  }
}

double TextCursor::number(const std::string& what) {
  const std::string_view found = token();
  double value = 0.0;
  if (found.empty()) {
    fail_truncated(what);
  }
  if (!parse_number(found, value)) {
    fail(what + " is " + quote(found) + ", not a number", "correct it or export the file again");
  }
  return value;
}

std::int64_t TextCursor::integer(const std::string& what) {
  const std::string_view found = token();
  std::int64_t value = 0;
  if (found.empty()) {
    fail_truncated(what);
  }
  if (!parse_number(found, value)) {
    fail(what + " is " + quote(found) + ", not a whole number", "correct it or export the file again");
  }
  return value;
}

void TextCursor::fail(const std::string& what, const std::string& advice) const {
  fail_reading(name_, "line " + std::to_string(line_), what, advice);
}

void TextCursor::fail_truncated(const std::string& expected) const {
  fail("the file ends where " + expected + " should be", "it is truncated; copy or export it again");
}

}  // namespace penumbra::detail
