#include "volumes/sections/section_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <ostream>
#include <sstream>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {
namespace {

// Pixels.
constexpr double kLonger = 720.0;  ///< of the drawing's sides
constexpr double kMargin = 40.0, kLine = 22.0, kFont = 14.0;
constexpr double kLeastWidth = 420.0;  ///< so that the legend has room

struct Colors {
  const char *fill, *line;
};
/// From the outside to the inside: half-light, shadow, and what else there is.
constexpr std::array<Colors, 5> kColors{{{"#f3bf73", "#c07a1c"},
                                         {"#3d4a66", "#1b2438"},
                                         {"#6aa39b", "#2d6a62"},
                                         {"#b9798f", "#7d3a53"},
                                         {"#8d8fbf", "#4a4c86"}}};

/// Right and up of a plane seen against its normal. Up is as near to the y axis as can be, or to -z where the
/// plane is level.
struct PlaneAxes {
  explicit PlaneAxes(const SectionPlane& plane) {
    const Vec3 n = glm::normalize(plane.normal);
    const Vec3 upright = std::abs(n.y) < 0.9 ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, 0.0, -1.0);
    right = glm::normalize(glm::cross(upright, n));
    up = glm::cross(n, right);
  }
  Vec3 right, up;
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// The largest 1, 2 or 5 times a power of ten that is at most `most`.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

std::string short_number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// What is drawn, and where on the sheet.
class Sheet {
 public:
  Sheet(std::span<const NamedSection> sections, const SectionPlane& plane)
      : sections_(sections), plane_(plane), axes_(plane), order_(sections.size()) {
    for (const NamedSection& s : sections)
      for (const SectionCurve& curve : s.section.curves)
        for (const Vec3& p : curve.points) box_.add(flat(p));
    if (box_.empty()) box_.add(Vec3(0.0));
    widen();
    const Vec3 size = box_.high - box_.low;
    scale_ = kLonger / std::max(size.x, size.y);
    drawn_ = scale_ * size;
    width_ = std::ceil(std::max(drawn_.x, kLeastWidth) + 2.0 * kMargin);
    rows_ = std::max<std::size_t>(sections.size(), 2);  // beside the scale bar
    height_ = std::ceil(drawn_.y + 2.5 * kMargin + kLine * static_cast<double>(rows_));
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) { return area_of(a) > area_of(b); });
  }

  void write(std::ostream& out) const {
    out.precision(7);
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width_ << "\" height=\"" << height_
        << "\" viewBox=\"0 0 " << width_ << ' ' << height_ << "\" font-family=\"sans-serif\" font-size=\""
        << kFont << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    write_drawing(out);
    for (std::size_t k = 0; k < order_.size(); ++k) write_legend(out, k);
    write_scale_bar(out);
    out << "</svg>\n";
  }

 private:
  /// A straight line has a side of length 0, and such a viewBox shows nothing.
  void widen() {
    const double longer = std::max(box_.high.x - box_.low.x, box_.high.y - box_.low.y);
    for (int k = 0; k < 2; ++k)
      if (!(box_.high[k] > box_.low[k])) box_.high[k] += longer > 0.0 ? 1e-3 * longer : 1.0;
  }
  double area_of(std::size_t i) const { return sections_[i].section.area; }
  Vec3 flat(const Vec3& p) const {
    return {glm::dot(axes_.right, p - plane_.point), -glm::dot(axes_.up, p - plane_.point), 0.0};
  }
  double line_y(std::size_t row) const {
    return drawn_.y + 2.0 * kMargin + kLine * (static_cast<double>(row) + 0.5);
  }

  void write_drawing(std::ostream& out) const {
    const double left = 0.5 * (width_ - drawn_.x);
    out << "<svg x=\"" << left << "\" y=\"" << kMargin << "\" width=\"" << drawn_.x << "\" height=\""
        << drawn_.y << "\" viewBox=\"0 0 " << box_.high.x - box_.low.x << ' ' << box_.high.y - box_.low.y
        << "\" overflow=\"visible\" stroke-linejoin=\"round\" stroke-width=\"" << 1.25 / scale_
        << "\" fill-rule=\"evenodd\">\n";
    for (std::size_t k = 0; k < order_.size(); ++k)
      write_path(out, sections_[order_[k]], kColors[k % kColors.size()]);
    out << "</svg>\n";
  }

  void write_path(std::ostream& out, const NamedSection& s, const Colors& colors) const {
    // An open curve bounds nothing.
    const bool closed = std::ranges::all_of(s.section.curves, &SectionCurve::closed);
    out << "<path fill=\"" << (closed ? colors.fill : "none") << "\" stroke=\"" << colors.line << "\" d=\"";
    for (const SectionCurve& curve : s.section.curves) {
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vec3 p = flat(curve.points[i]) - box_.low;
        out << (i == 0 ? "M" : "L") << p.x << ' ' << p.y;
      }
      out << (curve.closed ? "Z" : "");
    }
    out << "\"><title>" << escaped(s.name) << "</title></path>\n";
  }

  void write_legend(std::ostream& out, std::size_t row) const {
    const NamedSection& s = sections_[order_[row]];
    const Colors& colors = kColors[row % kColors.size()];
    const double y = line_y(row);
    out << "<rect x=\"" << kMargin << "\" y=\"" << y - 7.0 << "\" width=\"20\" height=\"14\" rx=\"2\" fill=\""
        << colors.fill << "\" stroke=\"" << colors.line << "\"/>\n<text x=\"" << kMargin + 30.0 << "\" y=\""
        << y + 5.0 << "\" fill=\"#222\">" << escaped(s.name) << "<tspan fill=\"#777\">, area "
        << short_number(area_of(order_[row])) << "</tspan></text>\n";
  }

  void write_scale_bar(std::ostream& out) const {
    const double length = round_length(0.25 * width_ / scale_), pixels = scale_ * length;
    const double right = width_ - kMargin, left = right - pixels, y = line_y(0);
    out << "<path d=\"M" << left << ' ' << y - 4.0 << "v8m0-4H" << right
        << "m0-4v8\" fill=\"none\" stroke=\"#222\"/>\n<text x=\"" << 0.5 * (left + right) << "\" y=\""
        << line_y(1) + 2.0 << "\" fill=\"#222\" text-anchor=\"middle\">" << short_number(length)
        << (length == 1.0 ? " scene unit" : " scene units") << "</text>\n";
  }

  std::span<const NamedSection> sections_;
  const SectionPlane& plane_;
  PlaneAxes axes_;
  std::vector<std::size_t> order_;
  Bounds box_;          ///< of what is drawn, in scene units, y down
  double scale_ = 1.0;  ///< pixels a scene unit
  Vec3 drawn_{0.0};     ///< pixels
  double width_, height_;
  std::size_t rows_;
};

}  // namespace

void write_section_svg(std::ostream& out, std::span<const NamedSection> sections, const SectionPlane& plane) {
  Sheet(sections, plane).write(out);
}

}  // namespace penumbra::detail
