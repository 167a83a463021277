#include "view/frames.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <variant>

#include "view/painter.h"

namespace vorpipe::view {
namespace {

/// Returns the request with half as many rows and columns, with marks of the same relative size, and without
/// what would be illegible.
FrameRequest previewOf(FrameRequest request) {
  RenderOptions& picture = request.picture;
  picture.width /= 2;
  picture.height /= 2;
  picture.antialias = 1;
  picture.legend = picture.labels = false;
  picture.edge_width = std::max(1.0, picture.edge_width / 2);
  picture.dot_size /= 2;
  return request;
}

}  // namespace

struct Frames::State {
  State(std::function<void()> waker, Load loader) : wake(std::move(waker)), load(std::move(loader)) {}

  std::function<void()> wake;
  Load load;
  std::mutex mutex;  ///< protects the members below, up to `results`
  std::condition_variable wanted;
  std::optional<FrameRequest> request{};
  using File = std::variant<Save, std::string>;
  std::deque<File> files{};  ///< files to write, or paths of files to load
  bool stops = false;
  std::deque<RenderResult> results{};
  // Polled by computations to learn whether they are still wanted.
  std::atomic<std::uint64_t> latest_request{0}, latest_gesture{0};
  std::atomic<bool> gives_up{false};
  // Used by the thread only.
  Painter painter{};
  bool may_measure = false;
  std::uint64_t gesture = 0;      ///< of the previous request
  double sharp_milliseconds = 0;  ///< time of the last sharp picture
  bool knows_devices = false;
  std::thread thread{};

  void addFile(File file) {
    {
      const std::scoped_lock lock(mutex);
      files.push_back(std::move(file));
    }
    wanted.notify_all();
  }

  void work() {
    std::unique_lock lock(mutex);
    for (;;) {
      wanted.wait(lock, [&] { return stops || request || !files.empty() || may_measure; });
      if (stops) return;
      if (request) {
        const FrameRequest next = std::move(*std::exchange(request, std::nullopt));
        lock.unlock();
        render(next);
      } else if (!files.empty()) {
        const auto next = std::move(files.front());
        files.pop_front();
        lock.unlock();
        if (const auto* const save = std::get_if<Save>(&next)) {
          write(*save);
        } else {
          read(std::get<std::string>(next));
        }
      } else {
        lock.unlock();
        workIdly();
      }
      lock.lock();
    }
  }

  RenderResult paint(const FrameRequest& next, const Outdated& outdated) {
    try {
      return painter.paint(next, outdated);
    } catch (const std::bad_alloc&) {
      RenderResult result{};
      result.request = next.number;
      result.error = Error{ErrorCode::device, "there is not enough memory for this"};
      return result;
    }
  }

  /// Draws a preview, which is ready sooner, while something is dragged and sharp pictures are slow.
  void preview(const FrameRequest& next, const Outdated& outdated) {
    RenderResult result = paint(previewOf(next), outdated);
    // The sharp picture will report the error.
    if (!result.frame) return;
    result.request = 0;
    result.preview = std::exchange(result.frame, std::nullopt);
    post(std::move(result));
  }

  void render(const FrameRequest& next) {
    const bool continues =
        std::exchange(gesture, next.gesture) == next.gesture && next.motion == Motion::rests;
    const bool previews = continues && next.strokes.empty() &&
                          sharp_milliseconds > next.longest_without_preview && next.picture.width > 1 &&
                          next.picture.height > 1;
    const Outdated other_gesture = [&] { return gives_up || latest_gesture != next.gesture; };
    if (previews) preview(next, other_gesture);
    // With previews, a sharp picture that is already outdated is not finished.
    RenderResult result = paint(
        next, previews ? Outdated([&] { return gives_up || latest_request != next.number; }) : other_gesture);
    if (result.frame) sharp_milliseconds = result.frame->milliseconds;
    may_measure = result.frame && next.motion != Motion::runs;
    // A cancelled request is completed by the request that replaced it.
    if (!result.error || result.error->code != ErrorCode::cancelled) post(std::move(result));
  }

  void write(const Save& next) {
    RenderResult result{};
    if (auto saved = painter.save(next); saved) {
      result.saved = next.path;
    } else {
      result.error = std::move(saved.error());
    }
    post(std::move(result));
  }

  void read(const std::string& path) {
    RenderResult result{};
    result.loaded_path = path;
    if (auto loaded = load(path); loaded) {
      result.loaded = std::move(*loaded);
    } else {
      result.error = std::move(loaded.error());
    }
    post(std::move(result));
  }

  /// Work for times when the window wants nothing else.
  void workIdly() {
    may_measure = false;
    RenderResult result{};
    const std::uint64_t now = latest_request;
    result.measures = painter.measure([&] { return gives_up || latest_request != now; });
    if (!knows_devices) {
      knows_devices = true;
      result.devices = devices({});
    }
    if (result.measures || !result.devices.empty()) post(std::move(result));
  }

  void post(RenderResult result) {
    {
      const std::scoped_lock lock(mutex);
      results.push_back(std::move(result));
    }
    wake();
  }
};

Frames::Frames(std::function<void()> wake, Load load)
    : state_(std::make_unique<State>(std::move(wake), std::move(load))) {
  state_->thread = std::thread([this] { state_->work(); });
}

Frames::~Frames() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stops = true;
  }
  state_->gives_up = true;
  state_->wanted.notify_all();
  state_->thread.join();
}

void Frames::request(FrameRequest request) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->latest_request = request.number;
    state_->latest_gesture = request.gesture;
    state_->request = std::move(request);
  }
  state_->wanted.notify_all();
}

void Frames::save(Save save) { state_->addFile(std::move(save)); }

void Frames::load(std::string path) { state_->addFile(std::move(path)); }

std::optional<RenderResult> Frames::next() {
  const std::scoped_lock lock(state_->mutex);
  if (state_->results.empty()) return std::nullopt;
  RenderResult result = std::move(state_->results.front());
  state_->results.pop_front();
  return result;
}

}  // namespace vorpipe::view
