#include "view/schedule.h"

#include <algorithm>
#include <utility>

namespace roomlight::view {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::minutes kLostWindow{10};  // is kept
constexpr size_t kMostWindows = 64;
constexpr size_t kMostLit = 3;  // kept, so that going back to a technique or plan is quick
// Without an input: before that a better picture is not begun, since the next input would end it.
constexpr milliseconds kRest{80};
// After an input that was shown, at most: light that follows it has the machine for itself.
constexpr milliseconds kForLight{2500};
// Where changes go on, a meter waits for no more than this, between two of them, and bounces may be missing.
constexpr milliseconds kMeterPatience{1000};

class Planner {
 public:
  Planner(const Situation& situation, TimePoint now) : s_(situation), now_(now) {}

  Plan plan() {
    stopRefining();
    light();
    forgetWindows();
    dropHomes();
    follow();
    if (!serveAWindow()) refine();
    return std::move(plan_);
  }

 private:
  // Whether the time has come; if not, the plan is to be looked at again when it has.
  bool isTime(TimePoint at) {
    if (now_ >= at) return true;
    plan_.wakeAt = std::min(plan_.wakeAt, at);
    return false;
  }
  template <class A>
  void act(A action) {
    plan_.actions.push_back(std::move(action));
  }
  HomeFacts* homeOf(const LightKey& key) {
    const auto h = std::find_if(s_.homes.begin(), s_.homes.end(), [&](const HomeFacts& x) { return x.key == key; });
    return h == s_.homes.end() ? nullptr : &*h;
  }
  const WindowFacts* windowOf(const std::string& name) const {
    const auto w =
        std::find_if(s_.windows.begin(), s_.windows.end(), [&](const WindowFacts& x) { return x.name == name; });
    return w == s_.windows.end() ? nullptr : &*w;
  }
  // Of windows that are connected, or also of those that may come back.
  bool isLookedAt(const LightKey& key, bool alsoByLost) const {
    return std::any_of(s_.windows.begin(), s_.windows.end(), [&](const WindowFacts& w) {
      return (w.isConnected || alsoByLost) &&
             std::any_of(w.sides.begin(), w.sides.end(), [&](const SideFacts& s) { return s.key == key; });
    });
  }
  // Whether light has come to where the home is.
  static bool isUpToDate(const HomeFacts& h) { return !h.isAway && h.hasState && h.isSettled; }
  // Whether there is something to make pictures of. One that is not live is looked at as its light is, and not while
  // that follows.
  static bool canBeShown(const HomeFacts& h) { return h.isLive || !h.isAway; }

  void endRefining() {
    act(StopRefining{});
    s_.refining.reset();
  }

  // Of a picture that nobody looks at any more, or for a final one.
  void stopRefining() {
    if (!s_.refining) return;
    const WindowFacts* window = windowOf(s_.refining->window);
    const bool isOld = !window || !window->isConnected || window->serial != s_.refining->serial ||
                       s_.refining->side >= window->sides.size();
    if (isOld || s_.rendersFinal) endRefining();
  }

  // Of all that windows look at, the first that has no light, or light that cannot follow the sun.
  void light() {
    if (s_.building) {
      if (!isLookedAt(*s_.building, true)) act(GiveUpLighting{});
      return;
    }
    for (const WindowFacts& w : s_.windows) {
      for (size_t k = 0; k < w.sides.size() && w.isConnected; ++k) {
        const LightKey& key = w.sides[k].key;
        const HomeFacts* home = homeOf(key);
        const bool failed = std::find(s_.failed.begin(), s_.failed.end(), key.technique) != s_.failed.end();
        if (failed || (home && home->canFollow)) continue;
        if (isTime(s_.mayStartAt)) act(LightHome{w.name, k});
        return;
      }
    }
  }

  void forgetWindows() {
    size_t count = s_.windows.size();
    std::erase_if(s_.windows, [&](const WindowFacts& w) {
      if (w.isConnected || (count <= kMostWindows && !isTime(w.leftAt + kLostWindow))) return false;
      act(ForgetWindow{w.name});
      --count;
      return true;
    });
  }

  // Beyond a few those that nobody looks at and that were not used for longest; those that a thread still works on
  // another time.
  void dropHomes() {
    for (size_t k = s_.homes.size(); k > 0 && s_.homes.size() > kMostLit; --k) {
      const HomeFacts& home = s_.homes[k - 1];
      if (isLookedAt(home.key, false) || home.isAway) continue;
      act(DropHome{home.key});
      s_.homes.erase(s_.homes.begin() + static_cast<std::ptrdiff_t>(k - 1));
    }
  }

  bool canBeMetered(const WindowFacts& w, const HomeFacts& h) {
    if (h.isAway) return false;
    return isUpToDate(h) || (h.revision >= w.metersRevision && isTime(w.metersSince + kMeterPatience));
  }

  bool meterIsDue(const HomeFacts& h) {
    return std::any_of(s_.windows.begin(), s_.windows.end(), [&](const WindowFacts& w) {
      return w.isConnected && w.meters && w.hasSize && w.sides.front().key == h.key && canBeShown(h) &&
             canBeMetered(w, h);
    });
  }

  // Whether a window is to see light that came before it goes on, or, where only bounces are missing, what its eye has
  // come to.
  bool isOwedAFrame(const HomeFacts& h) const {
    return std::any_of(s_.windows.begin(), s_.windows.end(), [&](const WindowFacts& w) {
      return w.isConnected && w.takesFrames && std::any_of(w.sides.begin(), w.sides.end(), [&](const SideFacts& s) {
               return s.key == h.key && (s.lightCame || (h.hasState && !s.isCurrent));
             });
    });
  }

  // The light of a home that windows look at and that has changed, or bounces that it still owes: of several in turn.
  void follow() {
    if (std::any_of(s_.homes.begin(), s_.homes.end(), [](const HomeFacts& h) { return h.isAway; })) return;
    HomeFacts* next = nullptr;
    for (HomeFacts& home : s_.homes) {
      if (!isLookedAt(home.key, false) || isUpToDate(home) || meterIsDue(home)) continue;
      if (!home.isLive && isOwedAFrame(home)) continue;
      if (!next || home.followedAt < next->followedAt) next = &home;
    }
    if (!next || !isTime(s_.mayStartAt)) return;
    act(FollowLight{next->key});
    next->isAway = true;
  }

  // Answers and one frame for one window.
  bool serveAWindow() {
    for (const WindowFacts& w : s_.windows) {
      if (!w.isConnected) continue;
      const bool answers = answer(w), shows = makeFrame(w);
      if (answers || shows) return true;
    }
    return false;
  }

  bool answer(const WindowFacts& w) {
    if ((!w.picks && !w.meters) || !w.hasSize) return false;
    const HomeFacts* home = homeOf(w.sides.front().key);
    if (!home || !canBeShown(*home)) return false;
    const bool meter = w.meters && canBeMetered(w, *home);
    if (!w.picks && !meter) return false;
    act(AnswerPoints{w.name, meter});
    return true;
  }

  // Of the side that is behind, else of the one with fewer samples.
  bool makeFrame(const WindowFacts& w) {
    if (!w.takesFrames) return false;
    std::optional<FrameKind> kind;
    size_t best = 0;
    for (size_t k = 0; k < w.sides.size(); ++k) {
      const SideFacts &side = w.sides[k], &other = w.sides[best];
      const HomeFacts* home = homeOf(side.key);
      const std::optional<FrameKind> wanted = home ? frameFor(w, side, *home) : std::nullopt;
      if (!wanted) continue;
      const bool isBefore = side.isCurrent != other.isCurrent ? !side.isCurrent : side.samples < other.samples;
      if (!kind || isBefore) kind = wanted, best = k;
    }
    if (kind) act(MakeFrame{w.name, best, *kind});
    return kind.has_value();
  }

  std::optional<FrameKind> frameFor(const WindowFacts& w, const SideFacts& side, const HomeFacts& home) {
    if (!canBeShown(home)) return {};
    if (!side.isCurrent || side.lightCame) return FrameKind::Quick;
    if (side.isToBeShownAgain) return FrameKind::Again;
    const bool isFirst = side.samples == 0 && !side.quickSettled;  // quick frames still get better
    if (!isUpToDate(home)) {
      const bool makesMore = home.isLive && isFirst && isTime(w.inputAt + kForLight);
      return makesMore ? std::optional(FrameKind::Quick) : std::nullopt;
    }
    if (side.isAveraged || (side.samples > 0 && s_.rendersFinal)) return {};
    if (now_ >= w.inputAt + kRest) return everybodyRests() ? std::optional(FrameKind::Better) : std::nullopt;
    if (home.isLive && isFirst) return FrameKind::Quick;
    isTime(w.inputAt + kRest);
    return {};
  }

  // An input of any window ends what better pictures of others have begun, so that these would only take time from it.
  bool everybodyRests() {
    return std::all_of(s_.windows.begin(), s_.windows.end(),
                       [&](const WindowFacts& w) { return !w.isConnected || isTime(w.inputAt + kRest); });
  }

  // One picture at a time is put right by paths while nothing else is to be done: the one with the fewest samples.
  // Where several could be, they take turns.
  void refine() {
    if (s_.rendersFinal) return;
    const WindowFacts* window = nullptr;
    size_t best = 0;
    for (const WindowFacts& w : s_.windows) {
      for (size_t k = 0; k < w.sides.size(); ++k) {
        const bool isUnderWay = s_.refining && s_.refining->window == w.name && s_.refining->side == k;
        if (isUnderWay || !canBeRefined(w, w.sides[k])) continue;
        if (!window || w.sides[k].samples < window->sides[best].samples) window = &w, best = k;
      }
    }
    if (!window || !isTime(s_.mayStartAt)) return;
    if (s_.refining) {
      const SideFacts& now = windowOf(s_.refining->window)->sides[s_.refining->side];
      const bool isTurnOver = s_.refining->samples >= s_.refining->turn && window->sides[best].samples < now.samples;
      if (isTurnOver) endRefining();
    } else if (!s_.refinerWorks) {  // on a last blend, which takes about a second
      act(Refine{window->name, best});
    }
  }

  // As good as averages make it, and to be seen: the window takes frames.
  bool canBeRefined(const WindowFacts& w, const SideFacts& s) {
    if (!w.isConnected || !w.takesFrames || !s.isCurrent || s.failedToRefine || !s.isAveraged || s.isSettled)
      return false;
    const HomeFacts* home = homeOf(s.key);
    return home && !home->isAway;
  }

  Situation s_;  // as it will be once what is planned is done
  const TimePoint now_;
  Plan plan_;
};

}  // namespace

Plan planNext(const Situation& situation, TimePoint now) { return Planner(situation, now).plan(); }

}  // namespace roomlight::view
