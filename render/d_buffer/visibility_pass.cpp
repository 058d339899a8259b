#include "render/d_buffer/visibility_pass.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/light/disk_area.h"

namespace penumbra::detail {
namespace {

using gl::Object;
using gl::Program;

std::unique_ptr<Object> image_texture(const gl::Functions& gl, GLenum format, int width, int height) {
  auto texture = std::make_unique<Object>(gl, Object::Kind::kTexture);
  gl.BindTexture(GL_TEXTURE_2D, *texture);
  gl.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

/// Whether pixels are resampled by rays. Not for what the paper does itself: it has no rays.
bool resamples(const DBufferOptions& o) {
  return o.check == EntryCheck::kRays && o.contents == DBufferContents::kEdge &&
         o.curve == VisibilityCurve::kExact && o.center == CenterTest::kRay;
}

/// Whether trace_center has put the visibility without entries into the image already, at every pixel. If
/// not, the first pass finds it.
bool is_known(const DBufferOptions& o, int targets) {
  return o.center == CenterTest::kRay && targets <= 1;
}

}  // namespace

std::vector<std::uint32_t> uncertain_pixels(std::span<const EntryUse> uses) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; 2 * i < uses.size(); ++i)
    if (uses[2 * i].is_uncertain() || uses[2 * i + 1].is_uncertain()) out.push_back(i);
  return out;
}

/// The shaders for one combination of options.
struct VisibilityPass::Programs {
  Programs(const gl::Functions& gl, const DBufferOptions& options, int targets)
      : contents(options.contents),
        curve(options.curve),
        entries(options.entries),
        target_count(targets),
        known(is_known(options, targets)),
        center(gl, {kTiles, {GL_FRAGMENT_SHADER, "d_buffer_center.frag.glsl"}}, {{"TARGETS", targets}}),
        select(gl, {kTiles, {GL_FRAGMENT_SHADER, "d_buffer_select.frag.glsl"}},
               {{"TARGETS", targets}, {"KNOWN", known}}),
        visibility(gl, {kTiles, {GL_FRAGMENT_SHADER, "d_buffer_visibility.frag.glsl"}},
                   {{"TARGETS", targets},
                    {"CONTENTS", static_cast<int>(contents)},
                    {"CURVE", static_cast<int>(curve)},
                    {"ENTRIES", entries}}) {}
  bool fits(const DBufferOptions& options, int targets) const {
    return contents == options.contents && curve == options.curve && entries == options.entries &&
           known == is_known(options, targets) && target_count == targets;
  }

  static constexpr Program::Stage kTiles{GL_VERTEX_SHADER, "image_tiles.vert.glsl"};
  DBufferContents contents;
  VisibilityCurve curve;
  int entries, target_count;
  bool known;
  Program center, select, visibility;
};

VisibilityPass::VisibilityPass(const gl::Functions& gl)
    : gl_(gl), tile_array_(gl, Object::Kind::kVertexArray), tile_buffer_(gl, Object::Kind::kBuffer) {}

VisibilityPass::~VisibilityPass() = default;

void VisibilityPass::set_surface(const Receivers& surface, std::vector<std::uint32_t> first_face,
                                 const RayScene& rays) {
  width_ = surface.width;
  height_ = surface.height;
  points_.assign(surface.points.begin(), surface.points.end());
  normals_.assign(surface.normals.begin(), surface.normals.end());
  objects_.assign(surface.objects.begin(), surface.objects.end());
  faces_.assign(surface.faces.begin(), surface.faces.end());
  first_face_ = std::move(first_face);
  middle_ = receiver_middle(surface);
  surface_position_ = image_texture(gl_, GL_RGBA32F, width_, height_);
  surface_plane_ = image_texture(gl_, GL_RGBA32F, width_, height_);
  visibility_texture_ = image_texture(gl_, GL_R32F, width_, height_);
  use_texture_ = image_texture(gl_, GL_RG32UI, width_, height_);
  mark_texture_ = image_texture(gl_, GL_DEPTH_COMPONENT32F, width_, height_);
  center_seen_ = image_texture(gl_, GL_R32F, width_, height_);
  center_rays_ = std::make_unique<CenterRays>(surface, rays);
  isolated_ = isolated_pixels({this->surface(), {}});
  seen_.clear();
}

Receivers VisibilityPass::surface() const {
  return {.points = points_,
          .normals = normals_,
          .objects = objects_,
          .faces = faces_,
          .width = width_,
          .height = height_};
}

template <class T>
void VisibilityPass::upload(const gl::Object& texture, GLenum format, const std::vector<T>& texels) const {
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, format, GL_FLOAT, texels.data());
}

void VisibilityPass::trace_center(const CircularLight& light) {
  center_rays_->center_seen(light, seen_);
  upload(*center_seen_, GL_RED, seen_);
}

void VisibilityPass::place_receivers(const ReceiversInLight& receivers, const DBufferView& view) {
  texels_ = receivers.texels(view.space, first_face_);
  upload(*surface_position_, GL_RGBA, texels_.positions);
  upload(*surface_plane_, GL_RGBA, texels_.planes);
  if (seen_.empty()) return;
  find_open();
  upload(*visibility_texture_, GL_RED, without_entries_);
}

/// δ of a horizon is c / |(a, b)| of its plane.
void VisibilityPass::find_open() {
  open_.resize(seen_.size());
  without_entries_.resize(seen_.size());
  const auto open_at = [&](std::size_t i) {
    const float face = texels_.positions[i].w;
    if (!(face > 0.0f)) return face < 0.0f ? 0.0f : 1.0f;
    const glm::dvec4 plane(texels_.planes[i]);
    return static_cast<float>(half_plane_area(plane.z / std::hypot(plane.x, plane.y)));
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen_.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      open_[i] = open_at(i);
      without_entries_[i] = seen_[i] < 1.0f ? 0.0f : open_[i];
    }
  });
}

ImageReceivers VisibilityPass::receivers() const {
  return {width_, height_, texels_.positions, texels_.planes};
}

ReceiverGrid VisibilityPass::receiver_grid(const DBufferView& view, int size) const {
  return {receivers(), seen_, view.targets[0], size};
}

VisibilityPass::Programs& VisibilityPass::programs(const DBufferView& view, const DBufferOptions& options) {
  const int targets = static_cast<int>(view.targets.size());
  for (const auto& known : programs_)
    if (known->fits(options, targets)) return *known;
  programs_.push_back(std::make_unique<Programs>(gl_, options, targets));
  return *programs_.back();
}

void VisibilityPass::bind_textures(const Program& program, const DBufferLayers& layers,
                                   GLuint records) const {
  struct Binding {
    const char* name;
    GLenum kind;
    GLuint texture;
  };
  constexpr GLenum kArray = GL_TEXTURE_2D_ARRAY;
  const Binding bindings[] = {
      {"surface_position", GL_TEXTURE_2D, *surface_position_},
      {"surface_plane", GL_TEXTURE_2D, *surface_plane_},
      {"center_seen", GL_TEXTURE_2D, *center_seen_},
      {"occluder_face", kArray, layers.occluder.id.texture},
      {"occluder_depth", kArray, layers.occluder.depth.texture},
      {"last_depth", kArray, layers.last.texture},
      {"first_entry", kArray, layers.first_entries.id.texture},
      {"first_depth", kArray, layers.first_entries.depth.texture},
      {"second_entry", kArray, layers.second_entries.id.texture},
      {"second_depth", kArray, layers.second_entries.depth.texture},
      {"records", GL_TEXTURE_BUFFER, records},
  };
  int unit = 0;
  for (const Binding& b : bindings) {
    gl_.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    gl_.BindTexture(b.kind, b.texture);
    gl_.Uniform1i(program.uniform(b.name), unit++);
  }
  gl_.ActiveTexture(GL_TEXTURE0);
}

void VisibilityPass::shade_pixels(const Program& program, const DBufferView& view,
                                  const DBufferLayers& layers, GLuint records) const {
  program.use();
  const auto at = [&](const char* name) { return program.uniform(name); };
  gl_.Uniform1f(at("depth_scale"), static_cast<float>(view.depth_scale));
  std::vector<glm::mat3> axes;
  std::vector<glm::vec4> windows;
  for (const Target& t : view.targets) {
    axes.emplace_back(t.axes);
    windows.emplace_back(t.window[0], t.window[1], t.window[2], t.window[3]);
  }
  const auto count = static_cast<GLsizei>(axes.size());
  if (count > 0) {
    gl_.UniformMatrix3fv(at("target_axes"), count, GL_FALSE, &axes[0][0][0]);
    gl_.Uniform4fv(at("target_window"), count, &windows[0][0]);
  }
  bind_textures(program, layers, records);
  gl_.DrawArrays(GL_TRIANGLES, 0, tile_vertices_);
}

std::vector<glm::vec2> VisibilityPass::tiles(const DBufferView& view, const ReceiverGrid& grid,
                                             const EntryGeometry& geometry,
                                             const DBufferOptions& options) const {
  if (!is_known(options, static_cast<int>(view.targets.size())) || grid.is_everywhere()) return whole_image();
  if (view.targets.empty()) return {};
  return tiles_with_entries(receivers(), grid, geometry, view.targets[0]);
}

/// The passes draw them at depth 0.5.
void VisibilityPass::upload_tiles(const std::vector<glm::vec2>& tiles) {
  tile_vertices_ = static_cast<GLsizei>(tiles.size());
  gl_.BindVertexArray(tile_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, tile_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles.size() * sizeof(glm::vec2)), tiles.data(),
                 GL_STREAM_DRAW);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
  gl_.EnableVertexAttribArray(0);
}

void VisibilityPass::test_center_by_depth(const Programs& programs, const DBufferView& view,
                                          const DBufferLayers& layers, GLuint records) {
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *center_seen_, 0);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
  gl::require_complete_framebuffer(gl_, "testing the light's center");
  gl_.DepthFunc(GL_ALWAYS);
  shade_pixels(programs.center, view, layers, records);
  gl_.Finish();
}

/// Both passes draw into it; pixels that they leave out have none.
void VisibilityPass::begin_uses() const {
  constexpr GLuint kNone[4] = {0, 0, 0, 0};
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, *use_texture_, 0);
  constexpr GLenum kBoth[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl_.DrawBuffers(2, kBoth);
  gl_.ClearBufferuiv(GL_COLOR, 1, kNone);
}

std::vector<EntryUse> VisibilityPass::read_uses() const {
  std::vector<EntryUse> out(2 * seen_.size());
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RG_INTEGER, GL_UNSIGNED_INT, out.data());
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, 0, 0);
  return out;
}

/// What entries say, by points of the disk where the shader knows the area of two boundaries by their chords
/// alone.
float area_of(const SeenEntries& entries, float by_shader) {
  constexpr float kNoise = 0.02f;  // three times that of the points
  if (!entries.are_two()) return by_shader;
  float lit = 0.0f, all = 0.0f;
  for (std::size_t pattern = 0; pattern < CenterRays::kPatterns; ++pattern)
    for (const DiskPoint& p : CenterRays::points(pattern)) lit += entries.is_lit({p.x, p.y}), ++all;
  return std::abs(lit / all - by_shader) > kNoise ? lit / all : by_shader;
}

/// What rays find otherwise is added to what entries say, whose area is exact. But where fewer points are
/// seen than are denied, or fewer are hidden, their own share has less noise.
RaySample VisibilityPass::sample_of(std::uint32_t pixel, std::span<const SeenPoints> seen,
                                    std::span<const EntryUse> uses, const EntryGeometry& geometry,
                                    float by_entries) const {
  const SeenEntries entries(geometry.records, uses.subspan(2 * std::size_t{pixel}, 2),
                            Vec3(texels_.positions[pixel]), seen_[pixel] < 0.5f);
  const float area = area_of(entries, by_entries);
  int traced = 0, lit = 0, more = 0, denied = 0;
  for (const SeenPoints& s : seen)
    for (unsigned k = 0; k < s.points.size(); ++k) {
      if (!(s.traced >> k & 1)) continue;
      const bool sees = s.seen >> k & 1, expected = entries.is_lit({s.points[k].x, s.points[k].y});
      ++traced;
      lit += int{sees};
      more += int{sees} - int{expected};
      denied += int{sees != expected};
    }
  RaySample out{area, area != by_entries || denied > 0, traced > 0 && lit == 0, traced > 0 && lit == traced};
  if (denied == 0) return out;
  const auto share = [&](int points) {
    return open_[pixel] * static_cast<float>(points) / static_cast<float>(traced);
  };
  out.visibility =
      denied >= std::min(lit, traced - lit) ? share(lit) : std::clamp(area + share(more), 0.0f, open_[pixel]);
  return out;
}

/// Step 8.
void VisibilityPass::resample(const CircularLight& light, const EntryGeometry& geometry,
                              std::vector<float>& visibility) {
  const std::vector<EntryUse> uses = read_uses();
  const auto sample = [&](std::span<const std::uint32_t> pixels, SamplePoints points) {
    const bool all = points == SamplePoints::kAll;
    const std::vector<SeenPoints> seen =
        all ? center_rays_->all_seen_points(light, pixels) : center_rays_->seen_points(light, pixels);
    const std::size_t of_one = all ? CenterRays::kPatterns : 1;
    std::vector<RaySample> out(pixels.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 64), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k)
        out[k] = sample_of(pixels[k], std::span(seen).subspan(k * of_one, of_one), uses, geometry,
                           visibility[pixels[k]]);
    });
    return out;
  };
  std::vector<std::uint32_t> always = uncertain_pixels(uses);
  always.insert(always.end(), isolated_.begin(), isolated_.end());
  resampled_ = resampler_.resample({surface(), open_}, always, sample, visibility);
}

/// Two passes over the image: the first decides most pixels and marks the others by depth for the second.
std::vector<float> VisibilityPass::shade(const CircularLight& light, const DBufferView& view,
                                         const std::vector<glm::vec2>& tiles, const DBufferLayers& layers,
                                         const DrawnEntries& entries, const DBufferOptions& options) {
  Programs& with = programs(view, options);
  upload_tiles(tiles);
  gl_.Viewport(0, 0, width_, height_);
  if (options.center == CenterTest::kDepth) test_center_by_depth(with, view, layers, entries.records);
  const GLenum color = GL_COLOR_ATTACHMENT0;
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, color, GL_TEXTURE_2D, *visibility_texture_, 0);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, *mark_texture_, 0);
  gl_.DrawBuffers(with.known ? 0 : 1, &color);
  gl::require_complete_framebuffer(gl_, "shading from the D-buffer");
  gl_.DepthFunc(GL_ALWAYS);
  shade_pixels(with.select, view, layers, entries.records);
  gl_.DrawBuffers(1, &color);
  if (resamples(options)) begin_uses();
  gl_.DepthFunc(GL_LESS);  // tiles lie at depth 0.5
  shade_pixels(with.visibility, view, layers, entries.records);
  gl_.Finish();
  std::vector<float> out(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_.ReadBuffer(color);
  gl_.ReadPixels(0, 0, width_, height_, GL_RED, GL_FLOAT, out.data());
  resampled_ = 0;
  if (resamples(options)) resample(light, entries.geometry, out);
  return out;
}

}  // namespace penumbra::detail
