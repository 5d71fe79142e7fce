// The prediction kernels, of every instruction set that runs here, against the same operations one neighbour at a time,
// bit by bit; and that twin against contact times in 113 bits.

#include "core/prediction.hpp"
#include "core/contact_time.hpp"
#include "core/instructions.hpp"
#include "core/pair_step.hpp"
#include "core/unit_roundoff.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace carom::test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The kernel of one instruction set, or the best where this machine lacks it.
template <class Line>
const PredictionKernel<Line>& kernel(std::string_view set, PredictionKind kind = PredictionKind::hard) {
  const WithInstructions asked(set);
  return prediction_kernel<Line>(kind);
}

double radius_of(const Flight& /*line*/) { return 0.0; }
double radius_of(const SizedFlight& line) { return line.radius; }
double radius_of(const MixedFlight& line) { return line.radius; }

// ---------------------------------------------------------------------------------------------------------- the twin

/// With steps of that length along both axes.
PredictionFrame frame_of(double unit, double sigma, double half_width) {
  return {{unit, unit}, {1.0 / unit, 1.0 / unit}, sigma, half_width};
}

template <class Line>
double contact_distance(const PredictionFrame& frame, const Line& a, const Line& b) {
  if constexpr (std::is_same_v<Line, MixedFlight>)
    return (a.radius + b.radius) * frame.contact_scales[a.species * frame.kinds + b.species];
  else
    return sizeof(Line) > 32 ? radius_of(a) + radius_of(b) : frame.sigma;
}

template <class Line>
Vec2<double> separation_at(const PredictionFrame& frame, const Line& a, const Line& b, double now) {
  Vec2<double> r;
  for (int k = 0; k < 2; ++k)
    r[k] = static_cast<double>(wrapped_difference(a.x[k], b.x[k])) * frame.unit[k] + (a.v[k] - b.v[k]) * now;
  return r;
}

/// The formula of core/prediction_kernel.hpp.
template <class Line>
double meeting_time(const PredictionFrame& frame, const Line& a, const Line& b, double now) {
  const Vec2<double> r = separation_at(frame, a, b, now);
  const Vec2<double> v(a.v[0] - b.v[0], a.v[1] - b.v[1]);
  const double sigma = contact_distance(frame, a, b);
  const double approach = r[0] * v[0] + r[1] * v[1];
  const double s = r[0] * v[1] - r[1] * v[0];
  const double d = sigma * sigma * (v[0] * v[0] + v[1] * v[1]) - s * s;
  if (!(approach < 0.0) || !(d >= 0.0)) return never;
  const double c = (r[0] * r[0] + r[1] * r[1]) - sigma * sigma;
  const double wait = c / (std::sqrt(d) - approach);
  return now + (wait > 0.0 ? wait : 0.0);
}

/// When a line leaves the square round a centre.
template <class Line>
double leaving_time(const PredictionFrame& frame, const Line& a, const std::int32_t* centre, double now) {
  double first = never;
  for (int k = 0; k < 2; ++k) {
    if (a.v[k] == 0.0) continue;
    const auto middle = static_cast<std::int64_t>(static_cast<std::uint64_t>(centre[k]) << 32);
    const double off = static_cast<double>(wrapped_difference(a.x[k], middle)) * frame.unit[k] + a.v[k] * now;
    const double room = frame.half_width - (a.v[k] > 0.0 ? off : -off);
    first = std::min(first, now + std::max(room, 0.0) / std::abs(a.v[k]));
  }
  return first;
}

/// A list as the engine keeps them: padded with the disk itself.
struct List {
  std::vector<std::int32_t> ids;
  std::uint32_t count = 0;
  std::int32_t centre[2] = {0, 0};

  List(std::int32_t self, std::vector<std::int32_t> others)
      : ids(std::move(others)), count(static_cast<std::uint32_t>(ids.size())) {
    ids.resize(std::max<std::size_t>((ids.size() + 3) / 4 * 4, 12), self);
  }
  [[nodiscard]] Surroundings around() const { return {{centre[0], centre[1]}, ids.data(), count}; }
};

/// The twin's answer must be the kernel's: the time to the bit; a partner that has this time, and `tied` exactly where more
/// than one has.
template <class Line>
void expect_as_twin(const std::vector<Line>& lines, const PredictionFrame& frame, std::int32_t i, const List& list, double now,
                    const Prediction& found) {
  const Line& self = lines[static_cast<std::size_t>(i)];
  double first = never;
  int holders = 0;
  bool partner_holds = false;
  for (std::uint32_t k = 0; k < list.count; ++k) {
    const double time = meeting_time(frame, self, lines[static_cast<std::size_t>(list.ids[k])], now);
    if (time < first) first = time, holders = 0, partner_holds = false;
    if (time == first && time < never) ++holders, partner_holds = partner_holds || list.ids[k] == found.partner;
  }
  ASSERT_EQ(found.pair_time, first);
  ASSERT_EQ(found.partner >= 0, first < never);
  if (first < never) {
    ASSERT_TRUE(partner_holds) << found.partner;
  }
  ASSERT_EQ(found.tied != 0, holders > 1);
  ASSERT_EQ(found.edge_time, leaving_time(frame, self, list.centre, now));
}

// ------------------------------------------------------------------------------------------------- random and extreme

struct Drawn {
  PredictionFrame frame;
  double now;
  std::vector<SizedFlight> sized;
  std::vector<Flight> plain;
};

std::int64_t whole(double steps) { return static_cast<std::int64_t>(steps); }

/// Lines round a first one: near and far, grazing, touching, overlapping, at rest, alike, at the ends of the range.
Drawn draw(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto one_of = [&](std::initializer_list<double> all) {
    return all.begin()[static_cast<std::size_t>(unit(random) * static_cast<double>(all.size()))];
  };
  Drawn drawn;
  const double length = one_of({16.0, 10.0, 1e-3, 7e5});
  const double units[2] = {length * 0x1p-64, length * one_of({0x1p-64, 0x1p-61, 3.0 * 0x1p-64})};
  drawn.frame = {{units[0], units[1]}, {1.0 / units[0], 1.0 / units[1]}, length / 16.0, length * one_of({0.02, 0.3})};
  drawn.now = one_of({0.0, 1.0, 0.3, 123.456, 0x1p-20});
  const double sigma = drawn.frame.sigma;
  SizedFlight first{};
  const std::int64_t places[] = {0, INT64_MAX, INT64_MIN, INT64_MIN + 12345, -1, std::int64_t{1} << 62};
  for (int a = 0; a < 2; ++a) {
    first.x[a] = unit(random) < 0.5 ? places[static_cast<std::size_t>(unit(random) * 6)] : static_cast<std::int64_t>(random());
    first.v[a] = unit(random) < 0.2 ? 0.0 : length * (unit(random) - 0.5);
  }
  first.radius = sigma / 2.0;
  drawn.sized.push_back(first);
  for (std::size_t n = 1; n < count; ++n) {
    SizedFlight line{};
    line.radius = unit(random) < 0.5 ? sigma / 2.0 : sigma * unit(random);
    const double reach = first.radius + line.radius;
    // At a distance and an angle from the first at the epoch, by wrapping integers.
    const double distance = reach * one_of({1.0, 1.0, 0.999, 1.0 + 1e-15, 1.1, 2.0, 5.0, 0.0});
    const double angle = one_of({0.0, 1.5707963267948966, 6.28 * unit(random)});
    const double way[2] = {distance * std::cos(angle), distance * std::sin(angle)};
    const double speed = length * one_of({0.0, 1e-9, 0.1, 1.0, 1e6});
    const double turn = one_of({0.0, 3.141592653589793, 6.28 * unit(random)});
    for (int a = 0; a < 2; ++a) {
      line.v[a] = a == 0 ? speed * std::cos(angle + turn) : speed * std::sin(angle + turn);
      if (unit(random) < 0.1) line.v[a] = first.v[a];
      // so far away at `now`, if that can be had
      const double at_epoch = way[a] + (first.v[a] - line.v[a]) * drawn.now;
      const double steps = std::fmod(at_epoch / drawn.frame.unit[a], 0x1p63);
      line.x[a] = static_cast<std::int64_t>(static_cast<std::uint64_t>(first.x[a]) + static_cast<std::uint64_t>(whole(steps)));
      if (unit(random) < 0.02) line.x[a] = places[static_cast<std::size_t>(unit(random) * 6)];
    }
    if (n > 1 && unit(random) < 0.15) line = drawn.sized[static_cast<std::size_t>(1 + unit(random) * static_cast<double>(n - 1))];
    drawn.sized.push_back(line);
  }
  for (const SizedFlight& line : drawn.sized) drawn.plain.push_back({{line.x[0], line.x[1]}, {line.v[0], line.v[1]}});
  return drawn;
}

template <class Line>
void expect_predictions_of_twin(const Drawn& drawn, const std::vector<Line>& lines, std::mt19937_64& random, std::string_view set,
                                PredictionKind kind = PredictionKind::hard) {
  const auto count = static_cast<std::int32_t>(lines.size());
  std::vector<std::int32_t> others;
  for (std::int32_t j = 1; j < count; ++j) others.push_back(j);
  std::shuffle(others.begin(), others.end(), random);
  List list(0, others);
  for (int a = 0; a < 2; ++a) {
    // The neighbourhood lies round where the disk is, or a little off, or somewhere.
    const double offset = static_cast<double>(random() % 4);
    const double at = std::fmod(lines[0].v[a] * drawn.now / drawn.frame.unit[a], 0x1p63);
    const std::uint64_t place =
        static_cast<std::uint64_t>(lines[0].x[a]) + static_cast<std::uint64_t>(whole(at)) +
        static_cast<std::uint64_t>(whole(0.4 * offset * drawn.frame.half_width / drawn.frame.unit[a] / 2.0));
    list.centre[a] = offset == 3.0 ? static_cast<std::int32_t>(random()) : static_cast<std::int32_t>(place >> 32);
  }
  Prediction found;
  kernel<Line>(set, kind).predict(lines.data(), drawn.frame, 0, list.around(), drawn.now, found);
  expect_as_twin(lines, drawn.frame, 0, list, drawn.now, found);

  if (count < 2) return;
  // As after a collision: both have other velocities, get new lines, and are predicted from them.
  std::vector<Line> after = lines;
  unsigned wrapped = 0, downwards = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    Line& line = after[k / 2];
    const std::size_t a = k % 2;
    // The coordinate changes by less than half its range, by little, or not at all.
    const double most = random() % 4 == 0 ? 0.0 : std::ldexp(0.49, -static_cast<int>(random() % 60));
    const double share = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    const double change = share * most * drawn.frame.unit[a] * 0x1p64 / std::max(drawn.now, 1e-3);
    const double before = line.v[a], v = before - change;
    const double steps = (line.v[a] - v) * drawn.now * drawn.frame.steps[a];
    line.v[a] = std::abs(steps) < 0x1p62 ? v : line.v[a];  // fast disks have coarse velocities
    const auto nearest = [&](double speed) { return whole(std::nearbyint(speed * drawn.now * drawn.frame.steps[a])); };
    const std::int64_t by = std::abs(steps) >= 0x1p62         ? 0
                            : kind == PredictionKind::falling ? nearest(before) - nearest(line.v[a])
                                                              : whole(steps);
    const long double exact = static_cast<long double>(line.x[a]) + static_cast<long double>(by);  // has 64 digits
    line.x[a] = static_cast<std::int64_t>(static_cast<std::uint64_t>(line.x[a]) + static_cast<std::uint64_t>(by));
    wrapped |= static_cast<unsigned>(exact < -0x1p63L || exact >= 0x1p63L) << k;
    downwards |= static_cast<unsigned>(by < 0) << k;
  }
  std::vector<std::int32_t> round_second = {0};
  for (std::int32_t j = 2; j < count; ++j)
    if (random() % 2 == 0) round_second.push_back(j);
  List second(1, round_second);
  second.centre[0] = static_cast<std::int32_t>(after[1].x[0] >> 32);
  second.centre[1] = static_cast<std::int32_t>(after[1].x[1] >> 32);
  std::vector<Line> stored = lines;
  CollidedPair pair{{0, 1}, {list.around(), second.around()}, {}, 0, 0};
  const Line &a = after[0], &b = after[1];
  kernel<Line>(set, kind).turn_and_predict(stored.data(), drawn.frame, pair, drawn.now, a.v[0], a.v[1], b.v[0], b.v[1]);
  ASSERT_EQ(pair.wrapped, wrapped);
  ASSERT_EQ(pair.downwards, downwards);
  for (std::size_t k = 0; k < 2; ++k)
    for (int axis = 0; axis < 2; ++axis) {
      ASSERT_EQ(stored[k].x[axis], after[k].x[axis]);
      ASSERT_EQ(stored[k].v[axis], after[k].v[axis]);
      ASSERT_EQ(radius_of(stored[k]), radius_of(lines[k]));
    }
  expect_as_twin(after, drawn.frame, 0, list, drawn.now, pair.ahead[0]);
  expect_as_twin(after, drawn.frame, 1, second, drawn.now, pair.ahead[1]);
}

class PredictionKernels : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override {
    if (kernel<Flight>(GetParam()).name != GetParam()) GTEST_SKIP() << "not on this machine, or not in this build";
  }
};

TEST_P(PredictionKernels, GiveTheBitsOfOneNeighbourAtATimeInMixtures) {
  std::mt19937_64 random(8);
  const std::vector<double> scales = {1.0, 0.8, 1.5, 0.8, 1.0, 0.3, 1.5, 0.3, 1.0};
  for (int k = 0; k < 10'000; ++k) {
    Drawn drawn = draw(random, k % 3 == 0 ? 1 + random() % 40 : 1 + random() % 12);
    drawn.frame.contact_scales = scales.data();
    drawn.frame.kinds = 3;
    const PredictionKind kind = k % 2 == 0 ? PredictionKind::hard : PredictionKind::falling;
    for (SizedFlight& line : drawn.sized)
      for (int a = 0; a < 2; ++a)  // no line of a falling disk may be longer than a quarter of the range
        if (kind == PredictionKind::falling && std::abs(line.v[a] * drawn.now / drawn.frame.unit[a]) > 0x1p61) line.v[a] = 0.0;
    std::vector<MixedFlight> mixed;
    for (const SizedFlight& line : drawn.sized)
      mixed.push_back(
          {{line.x[0], line.x[1]}, {line.v[0], line.v[1]}, line.radius, 1.0, static_cast<std::int32_t>(random() % 3)});
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, mixed, random, GetParam(), kind)) << "case " << k;
  }
}

TEST_P(PredictionKernels, GiveTheBitsOfOneNeighbourAtATime) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20'000; ++k) {
    const std::size_t count = k % 3 == 0 ? 1 + random() % 40 : 1 + random() % 12;
    const Drawn drawn = draw(random, count);
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.plain, random, GetParam())) << "equal disks, case " << k;
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.sized, random, GetParam())) << "sized disks, case " << k;
  }
}

TEST_P(PredictionKernels, DrawNewLinesOfDisksThatFallFromTheNearestStep) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 10'000; ++k) {
    Drawn drawn = draw(random, 1 + random() % 12);
    for (std::size_t n = 0; n < drawn.sized.size(); ++n)
      for (int a = 0; a < 2; ++a) {  // no line may be longer than a quarter of the range
        double& v = drawn.sized[n].v[a];
        if (std::abs(v * drawn.now / drawn.frame.unit[a]) > 0x1p61) v = 0.0;
        drawn.plain[n].v[a] = v;
      }
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.plain, random, GetParam(), PredictionKind::falling))
        << "case " << k;
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.sized, random, GetParam(), PredictionKind::falling))
        << "case " << k;
  }
}

TEST_P(PredictionKernels, DrawTheSameLinesInSteps) {
  std::mt19937_64 random(6);
  for (const auto& [in_steps, as] : {std::pair(PredictionKind::falling_steps, PredictionKind::falling),
                                     std::pair(PredictionKind::steps, PredictionKind::hard)}) {
    for (int k = 0; k < 1'000; ++k) {
      Drawn drawn = draw(random, 2);
      const std::vector<std::vector<PairStep>> none(2);
      const double edges[] = {1.0, 1.5};
      drawn.frame.pair_steps = none.data();
      drawn.frame.edges = edges;
      drawn.frame.outside = 1;
      const List first(0, {1}), second(1, {0});
      const auto turned = [&](PredictionKind kind) {
        std::vector<SizedFlight> lines = drawn.sized;
        for (SizedFlight& line : lines)
          for (int a = 0; a < 2; ++a)
            if (std::abs(line.v[a] * drawn.now / drawn.frame.unit[a]) > 0x1p61) line.v[a] = 0.0;
        CollidedPair pair{{0, 1}, {first.around(), second.around()}, {}, 0, 0};
        kernel<SizedFlight>(GetParam(), kind)
            .turn_and_predict(lines.data(), drawn.frame, pair, drawn.now, 0.9 * lines[0].v[0], 0.7 * lines[0].v[1], 0.0, 0.0);
        return lines;
      };
      const auto lines = turned(in_steps), twins = turned(as);
      for (std::size_t i = 0; i < 2; ++i)
        for (int axis = 0; axis < 2; ++axis) ASSERT_EQ(lines[i].x[axis], twins[i].x[axis]) << k;
    }
  }
}

TEST_P(PredictionKernels, GiveTheSameBitsByAnEdgeThatSlidesForThoseOnOneSideOfIt) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 5'000; ++k) {
    Drawn drawn = draw(random, 1 + random() % 20);
    const std::vector<std::int32_t> heights(drawn.plain.size(), static_cast<std::int32_t>(random()));
    // Either all disks are by an edge, or those whose neighbourhoods are in the outer half.
    const std::int64_t inner = k % 2 == 0 ? 0 : 1 << 30;
    drawn.frame.sliding = {heights.data(), static_cast<std::int64_t>(random()), 3.0, inner};
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.plain, random, GetParam(), PredictionKind::sheared))
        << "case " << k;
    ASSERT_NO_FATAL_FAILURE(expect_predictions_of_twin(drawn, drawn.sized, random, GetParam(), PredictionKind::sheared))
        << "case " << k;
  }
}

TEST_P(PredictionKernels, MeetTheImagesBeyondAnEdgeThatSlides) {
  // Disk 1 beyond the edge is met as if its image were a disk on this side: displaced, and by the speed of the images faster. All
  // is dyadic, so nothing is rounded in writing it down.
  constexpr std::int32_t top = INT32_MAX - 1000, bottom = INT32_MIN + 1000;
  std::mt19937_64 random(4);
  const auto dyadic = [&] { return static_cast<double>(static_cast<std::int64_t>(random() % 4096) - 2048) / 1024.0; };
  int met = 0;
  for (int k = 0; k < 20'000; ++k) {
    PredictionFrame frame = frame_of(0x1p-60, 1.0, 0.5);
    const bool upwards = random() % 2 == 0;
    const std::vector<std::int32_t> across = {upwards ? top : bottom, upwards ? bottom : top}, beside(2, across[0]);
    const double speed = dyadic();
    frame.sliding = {across.data(), static_cast<std::int64_t>(random()), speed, 0};
    const auto displacement = static_cast<std::uint64_t>(frame.sliding.displacement);
    const Flight mine{{static_cast<std::int64_t>(random()), static_cast<std::int64_t>(random())}, {dyadic(), dyadic()}};
    Flight image{
        {static_cast<std::int64_t>(static_cast<std::uint64_t>(mine.x[0]) + static_cast<std::uint64_t>(whole(dyadic() * 0x1p60))),
         static_cast<std::int64_t>(static_cast<std::uint64_t>(mine.x[1]) + static_cast<std::uint64_t>(whole(dyadic() * 0x1p60)))},
        {dyadic(), dyadic()}};
    Flight other = image;
    other.x[0] = static_cast<std::int64_t>(static_cast<std::uint64_t>(image.x[0]) - (upwards ? displacement : ~displacement + 1));
    other.v[0] -= upwards ? speed : -speed;
    List list(0, {1});
    list.centre[1] = across[0];
    const double now = static_cast<double>(random() % 8) / 8.0;
    Prediction found, expected;
    kernel<Flight>(GetParam(), PredictionKind::sheared)
        .predict(std::vector{mine, other}.data(), frame, 0, list.around(), now, found);
    frame.sliding.heights = beside.data();
    kernel<Flight>(GetParam(), PredictionKind::sheared)
        .predict(std::vector{mine, image}.data(), frame, 0, list.around(), now, expected);
    ASSERT_EQ(found.pair_time, expected.pair_time);
    met += expected.pair_time < never ? 1 : 0;
  }
  EXPECT_GT(met, 1000) << "else the test says nothing";
}

TEST_P(PredictionKernels, ConvertEveryCoordinateDifferenceAsTheHardwareDoes) {
  // A neighbourhood of no width round 0, left at speed 1 from a coordinate x: in x, as a double.
  std::mt19937_64 random(2);
  const PredictionFrame narrow = frame_of(1.0, 0.0, 0.0);
  for (int k = 0; k < 20'000; ++k) {
    const auto bits = static_cast<std::int64_t>(random());
    const std::int64_t x = k % 4 == 0   ? bits
                           : k % 4 == 1 ? bits >> (random() % 64)
                           : k % 4 == 2 ? INT64_MAX - (bits & 3)
                                        : INT64_MIN + (bits & 2047);
    const Flight line{{x, 0}, {-1.0, 0.0}};
    const List list(0, {});
    Prediction found;
    kernel<Flight>(GetParam()).predict(&line, narrow, 0, list.around(), 0.0, found);
    ASSERT_EQ(found.edge_time, std::max(static_cast<double>(x), 0.0)) << x;
  }
}

TEST_P(PredictionKernels, FindNoDiskInPaddingAndNoneInAnEmptyList) {
  const std::vector<Flight> lines = {{{0, 0}, {1.0, -2.0}}};
  const PredictionFrame frame = frame_of(0x1p-60, 1.0, 0.5);
  for (const std::size_t padding : {8u, 16u, 24u}) {
    const std::vector<std::int32_t> ids(padding, 0);
    Prediction found;
    kernel<Flight>(GetParam())
        .predict(lines.data(), frame, 0, {{0, 0}, ids.data(), static_cast<std::uint32_t>(padding)}, 3.0, found);
    EXPECT_EQ(found.pair_time, never);
    EXPECT_EQ(found.partner, -1);
    EXPECT_EQ(found.tied, 0);
  }
}

TEST_P(PredictionKernels, SayThatTwoAreTiedWhereverTheyStandInTheList) {
  // Disk 0 at rest; 1 and 2 come from either side and touch it at t = 2; all others later.
  const double step = 0x1p-56;
  const PredictionFrame frame = frame_of(step, 1.0, 100.0);
  std::vector<Flight> lines(32);
  for (std::size_t j = 3; j < 32; ++j) lines[j] = {{whole((5.0 + static_cast<double>(j)) / step), 0}, {-1.0, 0.0}};
  lines[0] = {{0, 0}, {0.0, 0.0}};
  lines[1] = {{whole(3.0 / step), 0}, {-1.0, 0.0}};
  lines[2] = {{whole(-3.0 / step), 0}, {1.0, 0.0}};
  for (std::size_t length = 2; length <= 29; ++length)
    for (std::size_t p = 0; p < length; ++p)
      for (std::size_t q = 0; q < length; ++q) {
        if (p == q) continue;
        std::vector<std::int32_t> others;
        for (std::size_t k = 0; k < length; ++k) others.push_back(static_cast<std::int32_t>(k + 3));
        others[p] = 1;
        List one(0, others);
        others[q] = 2;
        List both(0, others);
        Prediction found;
        kernel<Flight>(GetParam()).predict(lines.data(), frame, 0, one.around(), 0.0, found);
        ASSERT_EQ(found.pair_time, 2.0);
        ASSERT_EQ(found.partner, 1);
        ASSERT_EQ(found.tied, 0);
        kernel<Flight>(GetParam()).predict(lines.data(), frame, 0, both.around(), 0.0, found);
        ASSERT_EQ(found.pair_time, 2.0);
        ASSERT_TRUE(found.partner == 1 || found.partner == 2);
        ASSERT_NE(found.tied, 0);
      }
}

TEST_P(PredictionKernels, FindTheFirstForBothDisksOfAPairWhereverItStandsAmongManyThatMeetThem) {
  // Two disks at rest, far apart, towards each of which all others of its list fly: one touches it at t = 2, one at t = 7, the
  // next at t = 8, and so on.
  const double step = 0x1p-56;
  const PredictionFrame frame = frame_of(step, 1.0, 100.0);
  std::vector<Flight> lines(64);
  for (std::size_t j = 0; j < 64; ++j) {
    const double distance = j % 32 == 0 ? 0.0 : j % 32 == 1 ? 3.0 : 6.0 + static_cast<double>(j % 32);
    lines[j] = {{whole(distance / step), whole((j < 32 ? 0.0 : 50.0) / step)}, {distance > 0.0 ? -1.0 : 0.0, 0.0}};
  }
  const auto list = [](std::int32_t self, std::size_t length, std::size_t place) {
    std::vector<std::int32_t> others;
    for (std::size_t k = 0; k < length; ++k) others.push_back(self + 2 + static_cast<std::int32_t>(k));
    if (place < length) others[place] = self + 1;
    return List(self, others);
  };
  for (std::size_t length_a = 0; length_a <= 20; ++length_a)
    for (std::size_t length_b = 0; length_b <= 20; ++length_b)
      for (std::size_t place = 0; place <= std::max(length_a, length_b); ++place) {
        const List first = list(0, length_a, place), second = list(32, length_b, place);
        CollidedPair pair{{0, 32}, {first.around(), second.around()}, {}, 0, 0};
        std::vector<Flight> turned = lines;
        kernel<Flight>(GetParam()).turn_and_predict(turned.data(), frame, pair, 0.0, 0.0, 0.0, 0.0, 0.0);
        ASSERT_NO_FATAL_FAILURE(expect_as_twin(lines, frame, 0, first, 0.0, pair.ahead[0])) << length_a << " " << place;
        ASSERT_NO_FATAL_FAILURE(expect_as_twin(lines, frame, 32, second, 0.0, pair.ahead[1])) << length_b << " " << place;
      }
}

TEST_P(PredictionKernels, MeetRoundThePeriodicEdge) {
  // A box of length 16: from 15.5 to 0.5 there is a way of 1 through the edge.
  const double step = 0x1p-60;
  const PredictionFrame frame = frame_of(step, 0.5, 100.0);
  const std::vector<Flight> lines = {{{whole(7.5 / step), 0}, {1.0, 0.0}}, {{whole(-7.5 / step), 0}, {0.0, 0.0}}};
  const List list(0, {1});
  Prediction found;
  kernel<Flight>(GetParam()).predict(lines.data(), frame, 0, list.around(), 0.0, found);
  EXPECT_EQ(found.pair_time, 0.5);
}

TEST_P(PredictionKernels, TouchingIsAnEventOnlyForDisksThatApproach) {
  const double step = 0x1p-60;
  const PredictionFrame frame = frame_of(step, 1.0, 100.0);
  const List list(0, {1});
  for (const double apart : {1.0, 0.75}) {
    for (const auto& [vx, vy, time] :
         {std::tuple(1.0, 0.5, 7.0), std::tuple(-1.0, 0.5, never), std::tuple(0.0, 0.5, never), std::tuple(0.0, 0.0, never)}) {
      // At now = 7 disk 1 stands `apart` to the right of disk 0.
      std::vector<Flight> lines = {{{whole(-7.0 * vx / step), whole(-7.0 * vy / step)}, {vx, vy}},
                                   {{whole(apart / step), 0}, {0.0, 0.0}}};
      Prediction found;
      kernel<Flight>(GetParam()).predict(lines.data(), frame, 0, list.around(), 7.0, found);
      EXPECT_EQ(found.pair_time, time) << apart << " " << vx;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, PredictionKernels, testing::ValuesIn(instruction_sets),
                         [](const auto& set) { return std::string(set.param); });

TEST(Instructions, AreThoseThatTheEnvironmentNamesOrTheBestThereAre) {
  const Instructions best = chosen_instructions();
  for (std::size_t k = 0; k < std::size(instruction_sets); ++k) {
    const auto set = static_cast<Instructions>(k);
    EXPECT_EQ(name_of(set), instruction_sets[k]);
    const WithInstructions asked(instruction_sets[k]);
    EXPECT_EQ(chosen_instructions(), std::min(set, best));
    EXPECT_STREQ(prediction_kernel<Flight>().name, name_of(chosen_instructions()));
    EXPECT_STREQ(prediction_kernel<SizedFlight>().name, name_of(chosen_instructions()));
  }
  for (const char* word : {"", "sse", "AVX2", "avx51", "avx512 "}) {
    const WithInstructions asked(word);
    EXPECT_EQ(chosen_instructions(), best) << word;
  }
}

// -------------------------------------------------------------------------------------------------------- the formula

/// The contact of r + v t in 113 bits, against what the kernel says. For the separation r that it starts from, docs/numerics.md
/// bounds the error of the distance at contact by 16 u h, h = |r| + sigma, with c = (|r| - sigma)(|r| + sigma): of these 7 u |r|
/// are c's. Here c = r^2 - sigma^2 is off by 2 u r^2 + u sigma^2 + u |c|, which moves the contact by at most that over r + sigma,
/// 3 u h: less. Adding the wait to `now` moves the disks by u (now + wait) |v| more.
void expect_contact(const SizedFlight& a, const SizedFlight& b, const PredictionFrame& frame, double now, double found) {
  using std::abs;
  using std::sqrt;
  const Vec2<double> near = separation_at(frame, a, b, now);
  const Vec2<Quad> r = near.cast<Quad>();
  const Vec2<double> speed(a.v[0] - b.v[0], a.v[1] - b.v[1]);
  const Vec2<Quad> v = speed.cast<Quad>();
  const double sigma = contact_distance(frame, a, b);
  const double h = near.norm() + sigma;
  const Quad approach = abs(cross<Quad>(r, v)) / sqrt(v.squaredNorm());
  if (found == never) {
    ASSERT_TRUE(!(r.dot(v) < 0) || approach > Quad(sigma - 4.0 * u * h)) << "a hit was missed";
    return;
  }
  ASSERT_LT(r.dot(v), 0);
  ASSERT_LT(approach, Quad(sigma + 4.0 * u * h)) << "a miss was taken for a hit";
  if (near.norm() < sigma * (1.0 - 4.0 * u)) {
    ASSERT_EQ(found, now);  // overlapping by more than its rounding
    return;
  }
  const Vec2<Quad> at = r + v * (Quad(found) - Quad(now));
  const double gap = static_cast<double>(sqrt(at.squaredNorm()) - Quad(sigma));
  ASSERT_LE(std::abs(gap), 16.0 * u * h + u * found * speed.norm());
}

TEST(Prediction, MeetsTheContactDistanceWithinTheBoundOfContactTimes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const PredictionFrame frame = frame_of(0x1p-50, 0.0, 1.0);  // a range of 2^14
  int hits = 0;
  for (int k = 0; k < 40'000; ++k) {
    const double sigma = 0.25 + unit(random);
    // Gaps of 1e-15 to 1e3 sigma; every other pass within 1e-16 to 1e-6 of grazing.
    const double distance = sigma * (1.0 + std::pow(10.0, -15.0 + 18.0 * unit(random)));
    const double graze = (unit(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, -16.0 + 10.0 * unit(random));
    const double impact = std::min(distance, sigma * (k % 2 == 0 ? 1.0 + graze : 1.2 * unit(random)));
    const double along = std::sqrt((distance - impact) * (distance + impact));
    const double angle = 6.28 * unit(random), speed = std::pow(10.0, -3.0 + 6.0 * unit(random));
    const double now = k % 3 == 0 ? 0.0 : unit(random) / speed;
    SizedFlight a{}, b{};
    a.radius = sigma * unit(random);
    b.radius = sigma - a.radius;
    a.v[0] = speed * std::cos(angle);
    a.v[1] = speed * std::sin(angle);
    const double r[2] = {-along * std::cos(angle) - impact * std::sin(angle),
                         -along * std::sin(angle) + impact * std::cos(angle)};
    for (int axis = 0; axis < 2; ++axis) a.x[axis] = whole((r[axis] - a.v[axis] * now) / frame.unit[axis]);
    const std::vector<SizedFlight> lines = {a, b};
    const List list(0, {1});
    Prediction found;
    prediction_kernel<SizedFlight>().predict(lines.data(), frame, 0, list.around(), now, found);
    ASSERT_NO_FATAL_FAILURE(expect_contact(a, b, frame, now, found.pair_time)) << "case " << k;
    hits += found.pair_time < never ? 1 : 0;
  }
  EXPECT_GT(hits, 20'000);
}

}  // namespace
}  // namespace carom::test
