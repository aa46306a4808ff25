// Which causes are dropped because windows of another length do not show them.
#include "curves/window_search.h"

#include <gtest/gtest.h>

#include <set>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

FoundCurve found(Place place, const std::string& shape, const std::vector<TiedCurve>& ties = {}) {
  FoundCurve cause;
  cause.place.place = place;
  cause.shape = shape;
  cause.ties = ties;
  return cause;
}

WindowSearch with(const std::vector<FoundCurve>& causes, std::size_t most) {
  WindowSearch search;
  search.result.causes.assign(causes.begin(),
                              causes.begin() + static_cast<long>(std::min(most, causes.size())));
  return search;
}

struct Confirmed {
  std::string said;
  std::vector<FoundCurve> causes, withheld;
};

/// Records that windows of 60 samples divide, and those of 120, too.
std::vector<Experiment> records(int samples) {
  Experiment record;
  record.u = record.y = Eigen::VectorXd::Zero(samples);
  return {record};
}

WindowPlan ofSixty() {
  WindowPlan plan;
  plan.length = 60;
  return plan;
}

/// What is left of the causes found in windows of 60 samples, if those of 90 show `others`.
Confirmed confirmed(const std::vector<FoundCurve>& causes, const std::vector<FoundCurve>& others,
                    bool ended_early = false) {
  const WindowSearcher search = [&](const WindowPlan& windows, const CurveSearchLimits& limits,
                                    Purpose purpose) {
    const bool tries_others = windows.length == 60 && limits.suggested != nullptr;
    EXPECT_EQ(purpose == Purpose::confirming, windows.length == 90 || tries_others);
    if (windows.length > 90) return WindowSearch();
    const auto most = static_cast<std::size_t>(limits.max_causes);
    WindowSearch searched = with(windows.length == 60 ? causes : others, most);
    searched.result.ended_early = windows.length == 90 && ended_early;
    return searched;
  };
  const PlannedSearch searched = searchInWindows(ofSixty(), records(720), {}, search);
  return {searched.refused, searched.found.result.causes, searched.withheld};
}

TEST(WindowSearch, KeepsWhatOtherWindowsShowAtTheSamePlace) {
  const FoundCurve root = found(Place::position, "root"), sine = found(Place::position, "sine");
  const Confirmed same = confirmed({root}, {found(Place::input, "power"), sine});
  EXPECT_TRUE(same.said.empty());
  EXPECT_EQ(same.causes.size(), 1u);
  const FoundCurve tied = found(Place::rate, "coulomb", {{{Place::position, ""}, "root"}});
  EXPECT_EQ(confirmed({tied}, {sine}).causes.size(), 1u) << "as a tie";
}

TEST(WindowSearch, DropsWhatTheyDoNotShowAndWhatWasFoundAfterIt) {
  const FoundCurve input = found(Place::input, "dead_zone"), rate = found(Place::rate, "coulomb"),
                   position = found(Place::position, "root");
  const Confirmed left = confirmed({input, rate, position}, {position, input});
  ASSERT_EQ(left.causes.size(), 1u);
  EXPECT_EQ(left.causes[0].shape, "dead_zone");
  ASSERT_EQ(left.withheld.size(), 2u);
  EXPECT_EQ(left.withheld[0].shape, "coulomb");
  EXPECT_TRUE(test::mentions(left.said, "plant_coulomb, plant_root"));
  EXPECT_TRUE(test::mentions(left.said, "not found in windows of 90"));
  EXPECT_TRUE(confirmed({input}, {}).causes.empty());
}

TEST(WindowSearch, NamesNothingThatThereWasNoTimeToConfirm) {
  const FoundCurve input = found(Place::input, "dead_zone");
  const Confirmed left = confirmed({input}, {}, true);
  EXPECT_TRUE(left.causes.empty());
  EXPECT_TRUE(test::mentions(left.said, "act_deadzone: simulates windows of about 60"));
  EXPECT_TRUE(test::mentions(left.said, "explanation.time_limit"));
  EXPECT_EQ(confirmed({input}, {input}, true).causes.size(), 1u)
      << "found before the time was over";
}

/// What is left of two causes that leave 1 out, if windows of 90 samples show another one, which
/// leaves so much out where it is fitted to those of 60.
std::vector<FoundCurve> leftBeside(double left_out_of_other) {
  const FoundCurve input = found(Place::input, "square"), rate = found(Place::rate, "curve"),
                   drag = found(Place::position, "square");
  const WindowSearcher search = [&](const WindowPlan& windows, const CurveSearchLimits& limits,
                                    Purpose) {
    if (windows.length > 90) return WindowSearch();
    const bool refits = windows.length == 60 && limits.suggested != nullptr;
    WindowSearch searched =
        with(std::vector<FoundCurve>{input, rate}, static_cast<std::size_t>(limits.max_causes));
    if (refits || windows.length == 90) searched.result.causes = {drag};
    searched.result.base.left_out = 10;
    searched.result.fit.left_out = refits ? left_out_of_other : 1;
    return searched;
  };
  return searchInWindows(ofSixty(), records(720), {}, search).found.result.causes;
}

TEST(WindowSearch, TakesFewerCausesThatOtherWindowsShowAndTheseConfirm) {
  const std::vector<FoundCurve> taken = leftBeside(1.05);
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].place.place, Place::position);
  EXPECT_TRUE(leftBeside(1.2).empty()) << "they leave a fifth more";
}

/// A search may miss what it would accept.
TEST(WindowSearch, SuggestsWhatWasFoundToTheSearchInOtherWindows) {
  const WindowSearcher search = [&](const WindowPlan& windows, const CurveSearchLimits& limits,
                                    Purpose purpose) {
    EXPECT_EQ(limits.suggested != nullptr, purpose == Purpose::confirming);
    if (limits.suggested) {
      EXPECT_EQ(limits.suggested->causes.size(), 1u);
    }
    return with({found(Place::input, "dead_zone")}, windows.length <= 90 ? 1 : 0);
  };
  const PlannedSearch searched = searchInWindows(ofSixty(), records(720), {}, search);
  EXPECT_EQ(searched.found.result.causes.size(), 1u);
}

TEST(WindowSearch, WhatAFoundCurveMayBeCalled) {
  using Names = std::vector<std::string>;
  const FoundCurve tied = found(Place::rate, "coulomb", {{{Place::position, ""}, "root"}});
  EXPECT_EQ(possibleNames(tied), (Names{"plant_coulomb", "plant_root"}));
  FoundCurve curve = found(Place::input, "curve");
  curve.nearest = "dead_zone";
  EXPECT_EQ(possibleNames(curve), (Names{"act_curve", "act_deadzone"}));
  FoundCurve heater = found(Place::covariate, "linear");
  heater.place.covariate = "heater";
  EXPECT_EQ(possibleNames(heater), Names()) << "or another covariate";
}

TEST(WindowSearch, CovariatesAreAlikeWhateverTheirLag) {
  FoundCurve near = found(Place::covariate, "linear"), far = near, other = near;
  near.place.covariate = "heater";
  far.place.covariate = "heater behind a lag of 4 s";
  other.place.covariate = "door";
  EXPECT_EQ(countConfirmed({near}, {far}), 1u);
  EXPECT_EQ(countConfirmed({near}, {other}), 0u);
}

TEST(WindowSearch, OtherWindowsAreLongerUnlessTheyWouldBeTooFew) {
  EXPECT_EQ(withOtherWindows(ofSixty(), records(720)).length, 90);
  EXPECT_EQ(withOtherWindows(ofSixty(), records(600)).length, 40) << "seven of 90";
}

TEST(WindowSearch, LongWindowsAreTwiceAsLongButNotTooFew) {
  EXPECT_EQ(withLongWindows(ofSixty(), records(600))->length, 120);
  EXPECT_EQ(withLongWindows(ofSixty(), records(400))->length, 100);
  EXPECT_FALSE(withLongWindows(ofSixty(), records(300)));
  WindowPlan whole = ofSixty();
  whole.one_of_each = true;
  EXPECT_FALSE(withLongWindows(whole, records(600)));
}

/// One held-out window, of which a plant that answers nothing simulates nothing.
SimulationData unexplained() {
  constexpr int kSamples = 60;
  SimulationData held;
  SimulationWindow window;
  window.u = window.time = Eigen::VectorXd::Zero(kSamples);
  window.y.resize(kSamples);
  for (int k = 0; k < kSamples; ++k) window.y[k] = k % 2 == 0 ? 1 : -1;
  window.measured = Eigen::ArrayXd::Ones(kSamples);
  held.windows = {window};
  held.longest = held.samples = kSamples;
  return held;
}

/// The search for a dead zone that windows of some lengths show, and that leaves `share` of the
/// squared error of held-out windows.
PlannedSearch shownIn(const std::set<int>& lengths, double share, const std::string& refused = "") {
  return searchInWindows(ofSixty(), records(720), {},
                         [&](const WindowPlan& windows, const CurveSearchLimits& limits, Purpose) {
                           const int most =
                               lengths.count(windows.length) > 0 ? limits.max_causes : 0;
                           WindowSearch searched = with({found(Place::input, "dead_zone")},
                                                        static_cast<std::size_t>(most));
                           searched.kept = unexplained();
                           searched.result.base.model.theta = Eigen::Vector3d::Zero();
                           searched.result.held_error = share * searched.baseError();
                           if (windows.length == 60 && !refused.empty())
                             searched.result.refused = {found(Place::input, refused)};
                           return searched;
                         });
}

TEST(WindowSearch, LooksInLongWindowsForWhatShortOnesDoNotShow) {
  const PlannedSearch in_long = shownIn({80, 120}, 0.25);
  EXPECT_GT(in_long.found.baseError(), 50);
  EXPECT_EQ(in_long.found.result.causes.size(), 1u);
  EXPECT_EQ(in_long.plan.length, 120);
  EXPECT_TRUE(shownIn({80, 120}, 0.35).found.result.causes.empty()) << "it must gain 70 %";
  EXPECT_TRUE(shownIn({80, 120}, 0.25, "saturation").found.result.causes.empty());
}

TEST(WindowSearch, WhatLeavesMuchMustShowInOtherWindowsToo) {
  EXPECT_TRUE(shownIn({60}, 0.25).found.result.causes.empty());
  EXPECT_EQ(shownIn({60, 90}, 0.25).found.result.causes.size(), 1u);
  EXPECT_EQ(shownIn({60}, 0.05).found.result.causes.size(), 1u) << "a tenth is little";
}

}  // namespace
}  // namespace uncertainty_identification
