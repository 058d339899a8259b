#include "penumbra/render/visibility.h"

#include "penumbra/mesh/error.h"
#include "render/casters_impl.h"
#include "render/light/valid_light.h"
#include "render/plan/unshadowed.h"

namespace penumbra {
namespace {

std::vector<SceneObject> objects_of(std::span<const TriangleMesh> meshes) {
  std::vector<SceneObject> objects;
  for (const TriangleMesh& mesh : meshes) objects.push_back({.name = {}, .mesh = mesh});
  return objects;
}

}  // namespace

Casters::Impl::Impl(std::vector<SceneObject> objects, int thread_count)
    : threads(detail::make_threads(thread_count)) {
  scene.objects = std::move(objects);
}

const RayScene& Casters::Impl::rays() {
  if (!rays_) rays_.emplace(scene, threads);
  return *rays_;
}

Method& Casters::Impl::method(const MethodInfo& info) {
  const auto known = methods_.find(info.name);
  if (known != methods_.end()) return *known->second;
  std::unique_ptr<Method> made = info.make(scene);
  if (!made) throw UsageError("method " + info.name + " could not be made");
  return *(methods_[info.name] = std::move(made));
}

void Casters::Impl::forget() {
  for (const auto& [name, method] : methods_) method->forget();
}

Casters::Casters(std::span<const TriangleMesh> meshes, int threads) : Casters(objects_of(meshes), threads) {}
Casters::Casters(std::vector<SceneObject> objects, int threads)
    : impl_(std::make_unique<Impl>(std::move(objects), threads)) {}
Casters::~Casters() = default;
Casters::Casters(Casters&&) noexcept = default;
Casters& Casters::operator=(Casters&&) noexcept = default;

const std::vector<SceneObject>& Casters::objects() const {
  return impl_->scene.objects;
}

MethodResult visibility(const Casters& casters, const LightShape& light, const Receivers& receivers,
                        const VisibilityOptions& options) {
  const MethodInfo& info = method_named(options.method);
  require_valid(receivers);
  require_valid(light);
  require_taken(info, light, receivers, options.with_unoccluded);
  require_known(options.options);
  const OptionValues values = completed(info.options, options.options);
  if (info.needs_pixels)
    for (const std::int32_t object : receivers.objects)
      if (object >= static_cast<std::int32_t>(casters.objects().size()))
        throw UsageError("a receiver lies on object " + std::to_string(object) + ", but there are only " +
                         std::to_string(casters.objects().size()));
  Casters::Impl& impl = casters.impl();
  const std::lock_guard lock(impl.mutex);
  const MethodInput input{.rays = impl.rays(),
                          .light = light,
                          .receivers = receivers,
                          .options = values,
                          .with_unoccluded = options.with_unoccluded,
                          .progress = options.progress};
  MethodResult result = impl.method(info).run(input);
  detail::fill_dark(input, result);
  require_complete(info, result, receivers.size());
  if (options.with_unoccluded && result.unoccluded.empty()) result.unoccluded = result.visibility;
  return result;
}

std::vector<MethodResult> visibility(const Casters& casters, std::span<const LightShape> lights,
                                     const Receivers& receivers, const VisibilityOptions& options) {
  Receivers kept = receivers;
  if (kept.revision == 0) kept.revision = new_revision();
  VisibilityOptions one = options;
  std::vector<MethodResult> results;
  const auto count = static_cast<double>(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    one.progress =
        part_of(options.progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    results.push_back(visibility(casters, lights[i], kept, one));
  }
  return results;
}

}  // namespace penumbra
