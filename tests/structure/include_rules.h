// The rules of which file may include which, as one table, and what breaks them.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace penumbra::structure {

/// One #include line of the project.
struct Include {
  std::string file;     ///< from the top of the source tree
  std::string written;  ///< what stands between the quotes or brackets
  bool quoted = true;
};

enum class Verb {
  kNeverIncludes,  ///< no file of `who` includes one of `what`
  kAloneIncludes,  ///< a file of `what` is included by files of `who` and by no others
};

/// `who` and `what` are patterns for the beginning of a path from the top, of an outside header between
/// brackets. In `what`, \1 is the first group of `who`.
struct Rule {
  const char* name;
  std::string who;
  Verb verb;
  std::string what;
  Include broken_by;  ///< an example
};
const std::vector<Rule>& rules();

/// An include that breaks the rule and stays for the time being.
struct Exemption {
  const char* rule;
  const char* file;
  const char* target;
  const char* why;
};
const std::vector<Exemption>& exemptions();

/// What the rules have to know of the source tree. Paths from the top.
struct Tree {
  std::set<std::string> files, public_headers;
  std::vector<Include> includes;
};
/// Of mesh, volumes, render, apps and tests. `public_headers` as the build lists them.
Tree read_tree(const std::string& top, std::set<std::string> public_headers);

/// A rule that an include breaks.
struct Finding {
  std::string rule, file, target;
  friend auto operator<=>(const Finding&, const Finding&) = default;
};
/// What a failing test says.
std::string text_of(const Finding& finding);

/// The path from the top that an include names: `written` without the public prefix.
std::string target_of(const Include& include);
std::vector<Finding> findings_of_table(const Tree& tree);
/// Public headers are included with the prefix penumbra/, internal ones without; what is included is there,
/// shaders apart; a public header includes no internal one.
std::vector<Finding> findings_of_public_headers(const Tree& tree);
/// The folders of a module include each other in no circle. What lies in folders of a folder counts as the
/// folder's, the module's own files do not count.
std::vector<Finding> findings_of_circles(const Tree& tree, const std::string& module);

}  // namespace penumbra::structure
