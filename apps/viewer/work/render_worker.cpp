#include "apps/viewer/work/render_worker.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

constexpr int kPreviewRays = 16;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool is_reference(const RenderOptions& options) {
  return method_named(options.method).converges;
}

int samples_of(const RenderOptions& options) {
  return static_cast<int>(
      integer_of(completed(method_named(options.method).options, options.options), "samples"));
}

bool has_reference(const std::vector<RenderOptions>& sides) {
  return std::any_of(sides.begin(), sides.end(), is_reference);
}

/// The mean of several images' visibility; odd and even ones are kept apart, as two independent references.
class Accumulator {
 public:
  void add(const std::vector<float>& visibility) {
    std::vector<double>& sum = sums_[static_cast<std::size_t>(passes_ % 2)];
    sum.resize(visibility.size());
    for (std::size_t i = 0; i < visibility.size(); ++i) sum[i] += double{visibility[i]};
    ++passes_;
  }
  int passes() const { return passes_; }
  std::vector<float> mean() const {
    std::vector<float> out(sums_[0].size());
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<float>((sums_[0][i] + (passes_ > 1 ? sums_[1][i] : 0.0)) / passes_);
    return out;
  }
  std::vector<float> half(int which) const {
    const int count = (passes_ + 1 - which) / 2;
    std::vector<float> out;
    for (const double sum : sums_[static_cast<std::size_t>(which)])
      out.push_back(static_cast<float>(sum / count));
    return out;
  }

 private:
  std::array<std::vector<double>, 2> sums_;
  int passes_ = 0;
};

std::optional<ErrorFigures> error_of(const Frame& frame, const Accumulator& reference) {
  if (frame.sides.size() != 2 || reference.passes() < 2) return std::nullopt;
  for (const Side& side : frame.sides) {
    if (is_reference(side.options)) continue;
    const SurfaceBuffer& surface = side.result->surface;
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < surface.size(); ++i)
      if (surface.hit(i)) seen.push_back(i);
    const std::vector<float> first = reference.half(0), second = reference.half(1);
    const std::vector<std::uint32_t> judged = true_penumbra(first, second, seen);
    return error_figures(side.result->image.at(frame.channel("visibility")), first, second, judged);
  }
  return std::nullopt;
}

/// Milliseconds of all sides without what is made once and what the camera sees, which stays while only a
/// light moves.
double without_camera(const Frame& frame) {
  double sum = 0.0;
  for (const Side& side : frame.sides)
    for (const StageTime& stage : side.result->stages)
      if (stage.name != "surface_buffer") sum += stage.milliseconds;
  return sum;
}

/// Whether the next picture takes as long. Where only a light moves, the first picture of another size does
/// not tell: the camera's rays, and receivers in groups, are kept for those that follow.
bool tells(const Frame& frame, bool camera_moved) {
  return camera_moved ||
         std::ranges::all_of(frame.sides, [](const Side& side) { return side.result->camera_rays == 0; });
}

}  // namespace

RenderWorker::RenderWorker(std::function<void()> notify)
    : notify_(std::move(notify)), thread_([this] { run(); }) {}

RenderWorker::~RenderWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RenderWorker::submit(RenderJob job) {
  {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(job);
  }
  wake_.notify_one();
}

std::shared_ptr<const Frame> RenderWorker::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

bool RenderWorker::outdated() const {
  const std::lock_guard lock(mutex_);
  return stop_ || wish_.has_value();
}

void RenderWorker::publish(Frame frame) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = std::make_shared<const Frame>(std::move(frame));
  }
  notify_();
}

void RenderWorker::run() {
  for (;;) {
    RenderJob job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || wish_.has_value(); });
      if (stop_) break;
      job = std::move(*wish_);
      wish_.reset();
    }
    Frame failed = first_frame(job);
    try {
      answer(job);
      continue;
    } catch (const Cancelled&) {
      continue;  // a newer wish is waiting
    } catch (const std::exception& e) {
      failed.trouble = e.what();
    }
    failed.final = true;
    publish(std::move(failed));
  }
  renderer_.reset();  // its context belongs to this thread
}

Frame RenderWorker::first_frame(const RenderJob& job) const {
  Frame frame;
  frame.number = job.number;
  frame.model = job.model;
  frame.lights = job.lights;
  frame.selected = job.selected;
  frame.camera = job.camera;
  return frame;
}

void RenderWorker::adopt(const RenderJob& job) {
  if (model_ != job.model || !renderer_) {
    renderer_.reset();  // before the new one takes memory
    Scene scene = *job.model;
    scene.lights = job.lights;
    scene.camera = job.camera;
    renderer_ = std::make_unique<Renderer>(std::move(scene));
    model_ = job.model;
  }
  for (std::size_t i = 0; i < job.lights.size(); ++i) renderer_->set_light(i, job.lights[i]);
  renderer_->set_camera(job.camera);
}

std::shared_ptr<RenderResult> RenderWorker::take_result() {
  constexpr std::size_t kMost = 6;  // two sides of each: the picture under way, the newest, the one drawn
  for (const auto& result : results_)
    if (result.use_count() == 1) {
      std::atomic_thread_fence(std::memory_order_acquire);  // after all that its last reader read
      return result;
    }
  auto result = std::make_shared<RenderResult>();
  if (results_.size() < kMost) results_.push_back(result);
  return result;
}

void RenderWorker::render_sides(const RenderJob& job, const std::vector<RenderOptions>& options,
                                Frame& frame) {
  const auto start = std::chrono::steady_clock::now();
  adopt(job);
  frame.sides.clear();
  for (RenderOptions each : options) {
    each.progress = [this](double) { return !outdated(); };
    std::shared_ptr<RenderResult> result = take_result();
    renderer_->render(each, *result);
    frame.sides.push_back(
        {.result = std::move(result), .options = each, .rays = is_reference(each) ? samples_of(each) : 0});
  }
  frame.milliseconds = milliseconds_since(start);
}

void RenderWorker::answer(const RenderJob& job) {
  Frame frame = first_frame(job);
  std::vector<RenderOptions> options = job.sides;
  const bool moved = !(std::exchange(camera_, job.camera) == job.camera);
  if (job.moving) {
    for (RenderOptions& each : options) each = draft_.draft_of(each);
    frame.reduction = draft_.reduction();
    render_sides(job, options, frame);
    if (tells(frame, moved)) draft_.took(frame.milliseconds, moved);
    return publish(std::move(frame));
  }
  if (has_reference(options)) {  // something to look at until all rays are traced
    for (RenderOptions& each : options)
      if (is_reference(each))
        each.options["samples"] = std::uint64_t(std::min(samples_of(each), kPreviewRays));
    render_sides(job, options, frame);
    frame.refining = true;
    publish(frame);
  }
  const bool is_new = model_ != job.model;
  render_sides(job, job.sides, frame);
  const bool as_cheap = std::ranges::all_of(job.sides, DraftPolicy::is_as_cheap);
  if (!is_new && tells(frame, moved)) draft_.took_in_full(frame.milliseconds, moved, as_cheap);
  if (is_new && as_cheap) draft_.start(without_camera(frame));
  frame.final = true;
  frame.refining = has_reference(job.sides) && job.refine_to > 0;
  publish(frame);
  if (frame.refining) refine(job, std::move(frame));
}

void RenderWorker::refine(const RenderJob& job, Frame frame) {
  const auto first = std::find_if(frame.sides.begin(), frame.sides.end(),
                                  [](const Side& side) { return is_reference(side.options); });
  RenderOptions options = first->options;
  const std::uint64_t seed = integer_of(first->result->options, "seed");
  std::vector<Accumulator> references(frame.lights.size());
  const auto add = [&](const RenderResult& result) {
    for (std::size_t k = 0; k < references.size(); ++k) references[k].add(result.lights[k].visibility);
  };
  add(*first->result);
  while (frame.refining) {
    const int passes = references.front().passes();
    options.options["seed"] = seed + static_cast<std::uint64_t>(passes);
    RenderResult pass = renderer_->render(options);
    add(pass);
    std::vector<std::vector<float>> means;
    for (const Accumulator& reference : references) means.push_back(reference.mean());
    pass.image = renderer_->shade_again(means);
    const auto result = std::make_shared<const RenderResult>(std::move(pass));
    const int rays = samples_of(options) * (passes + 1);
    for (Side& side : frame.sides)
      if (is_reference(side.options)) {
        side.result = result;
        side.rays = rays;
      }
    frame.refining = rays < job.refine_to;
    frame.error = error_of(frame, references[frame.selected]);
    if (outdated()) return;
    publish(frame);
  }
}

}  // namespace penumbra::viewer
