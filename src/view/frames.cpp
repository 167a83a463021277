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

/// Returns the wish with half as many rows and columns, with marks of the same relative size, and without
/// what would be illegible.
Wish previewOf(Wish wish) {
  RenderOptions& picture = wish.picture;
  picture.width /= 2;
  picture.height /= 2;
  picture.antialias = 1;
  picture.legend = picture.labels = false;
  picture.edge_width = std::max(1.0, picture.edge_width / 2);
  picture.dot_size /= 2;
  return wish;
}

}  // namespace

struct Frames::State {
  State(std::function<void()> waker, Load loader) : wake(std::move(waker)), load(std::move(loader)) {}

  std::function<void()> wake;
  Load load;
  std::mutex mutex;  ///< protects the members below, up to `answers`
  std::condition_variable wanted;
  std::optional<Wish> wish{};
  std::deque<std::variant<Save, std::string>> files{};  ///< files to write, or paths of files to load
  bool stops = false;
  std::deque<Answer> answers{};
  // Polled by computations to learn whether they are still wanted.
  std::atomic<std::uint64_t> latest_wish{0}, latest_gesture{0};
  std::atomic<bool> gives_up{false};
  // Used by the thread only.
  Painter painter{};
  bool may_measure = false;
  std::uint64_t gesture = 0;      ///< of the previous wish
  double sharp_milliseconds = 0;  ///< time of the last sharp picture
  bool knows_devices = false;
  std::thread thread{};

  void work();
  Answer paint(const Wish& next, const Outdated& outdated);
  void preview(const Wish& next, const Outdated& outdated);
  void fulfill(const Wish& next);
  void write(const Save& next);
  void read(const std::string& path);
  void beIdle();
  void tell(Answer answer);
};

void Frames::State::tell(Answer answer) {
  {
    const std::scoped_lock lock(mutex);
    answers.push_back(std::move(answer));
  }
  wake();
}

Answer Frames::State::paint(const Wish& next, const Outdated& outdated) {
  try {
    return painter.paint(next, outdated);
  } catch (const std::bad_alloc&) {
    Answer answer{};
    answer.wish = next.number;
    answer.error = Error{ErrorCode::device, "there is not enough memory for this"};
    return answer;
  }
}

/// Draws a preview, which is ready sooner, while something is dragged and sharp pictures are slow.
void Frames::State::preview(const Wish& next, const Outdated& outdated) {
  Answer answer = paint(previewOf(next), outdated);
  // The sharp picture will report the error.
  if (!answer.frame) return;
  answer.wish = 0;
  answer.preview = std::exchange(answer.frame, std::nullopt);
  tell(std::move(answer));
}

void Frames::State::fulfill(const Wish& next) {
  const bool goes_on = std::exchange(gesture, next.gesture) == next.gesture && next.motion == Motion::rests;
  const bool previews = goes_on && next.strokes.empty() &&
                        sharp_milliseconds > next.longest_without_preview && next.picture.width > 1 &&
                        next.picture.height > 1;
  const Outdated other_gesture = [&] { return gives_up || latest_gesture != next.gesture; };
  if (previews) preview(next, other_gesture);
  // With previews, a sharp picture that is already outdated is not finished.
  Answer answer = paint(
      next, previews ? Outdated([&] { return gives_up || latest_wish != next.number; }) : other_gesture);
  if (answer.frame) sharp_milliseconds = answer.frame->milliseconds;
  may_measure = answer.frame && next.motion != Motion::runs;
  // A cancelled wish is answered by the wish that replaced it.
  if (!answer.error || answer.error->code != ErrorCode::cancelled) tell(std::move(answer));
}

void Frames::State::write(const Save& next) {
  Answer answer{};
  if (auto saved = painter.save(next); saved) {
    answer.saved = next.path;
  } else {
    answer.error = std::move(saved.error());
  }
  tell(std::move(answer));
}

void Frames::State::read(const std::string& path) {
  Answer answer{};
  answer.loaded_path = path;
  if (auto loaded = load(path); loaded) {
    answer.loaded = std::move(*loaded);
  } else {
    answer.error = std::move(loaded.error());
  }
  tell(std::move(answer));
}

/// Work for times when the window wants nothing else.
void Frames::State::beIdle() {
  may_measure = false;
  Answer answer{};
  const std::uint64_t now = latest_wish;
  answer.measures = painter.measure([&] { return gives_up || latest_wish != now; });
  if (!knows_devices) {
    knows_devices = true;
    answer.devices = devices({});
  }
  if (answer.measures || !answer.devices.empty()) tell(std::move(answer));
}

void Frames::State::work() {
  std::unique_lock lock(mutex);
  for (;;) {
    wanted.wait(lock, [&] { return stops || wish || !files.empty() || may_measure; });
    if (stops) return;
    if (wish) {
      const Wish next = std::move(*std::exchange(wish, std::nullopt));
      lock.unlock();
      fulfill(next);
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
      beIdle();
    }
    lock.lock();
  }
}

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

void Frames::wish(Wish wish) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->latest_wish = wish.number;
    state_->latest_gesture = wish.gesture;
    state_->wish = std::move(wish);
  }
  state_->wanted.notify_all();
}

void Frames::save(Save save) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->files.emplace_back(std::move(save));
  }
  state_->wanted.notify_all();
}

void Frames::load(std::string path) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->files.emplace_back(std::move(path));
  }
  state_->wanted.notify_all();
}

std::optional<Answer> Frames::next() {
  const std::scoped_lock lock(state_->mutex);
  if (state_->answers.empty()) return std::nullopt;
  Answer answer = std::move(state_->answers.front());
  state_->answers.pop_front();
  return answer;
}

}  // namespace vorpipe::view
