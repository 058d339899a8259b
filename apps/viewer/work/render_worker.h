// Pictures in the background: a thread of its own with its own renderer and context, so that the window never
// waits. Only the latest wish counts; what is under way for an older one is dropped where it can be.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/viewer/work/draft.h"
#include "penumbra/render/image/error_figures.h"
#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

struct RenderJob {
  std::uint64_t number = 0;            ///< grows with each wish
  std::shared_ptr<const Scene> model;  ///< objects; its lights and camera are not used
  std::vector<Light> lights;
  std::size_t selected = 0;  ///< the light whose visibility is compared
  Camera camera;
  std::vector<RenderOptions> sides;  ///< one or two pictures
  bool moving = false;               ///< a draft will do
  int refine_to = 0;  ///< rays a pixel up to which a reference is refined; 0: no more than its setting
};

struct Side {
  std::shared_ptr<const RenderResult> result;
  RenderOptions options;  ///< as rendered
  int rays = 0;           ///< a pixel, of a reference
};

/// One answer. Never changed once published.
struct Frame {
  std::uint64_t number = 0;   ///< of the job
  bool final = false;         ///< everything as asked for; false: a draft, or a reference with few rays
  int reduction = 1;          ///< of a draft
  bool refining = false;      ///< more rays are on their way
  double milliseconds = 0.0;  ///< wall clock, all sides, set-up included
  std::shared_ptr<const Scene> model;
  std::vector<Light> lights;
  std::size_t selected = 0;
  Camera camera;
  std::vector<Side> sides;
  std::optional<ErrorFigures> error;  ///< of the side that is no reference, over true penumbra
  std::string trouble;                ///< why there are no sides

  /// The channel of the selected light: "visibility" or, of several, "visibility.NAME".
  std::string channel(const std::string& name) const {
    return lights.size() > 1 ? name + "." + lights[selected].name : name;
  }
};

class RenderWorker {
 public:
  /// `notify` is called from the thread whenever a frame is ready.
  explicit RenderWorker(std::function<void()> notify);
  ~RenderWorker();
  RenderWorker(const RenderWorker&) = delete;
  RenderWorker& operator=(const RenderWorker&) = delete;

  void submit(RenderJob job);
  /// The newest frame; null before the first.
  std::shared_ptr<const Frame> latest() const;

 private:
  void run();
  void answer(const RenderJob& job);
  /// A renderer that has the job's scene.
  void adopt(const RenderJob& job);
  Frame first_frame(const RenderJob& job) const;
  void render_sides(const RenderJob& job, const std::vector<RenderOptions>& options, Frame& frame);
  /// A result that nobody looks at any more, for its memory; else a new one.
  std::shared_ptr<RenderResult> take_result();
  void refine(const RenderJob& job, Frame frame);
  void publish(Frame frame);
  bool outdated() const;

  std::function<void()> notify_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<RenderJob> wish_;
  std::shared_ptr<const Frame> latest_;
  bool stop_ = false;

  // Only the thread's:
  std::shared_ptr<const Scene> model_;
  std::unique_ptr<Renderer> renderer_;
  /// Of the last picture.
  Camera camera_;
  DraftPolicy draft_;
  /// Of pictures; those of which there is no other owner are used again.
  std::vector<std::shared_ptr<RenderResult>> results_;
  std::thread thread_;
};

}  // namespace penumbra::viewer
