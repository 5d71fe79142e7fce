#include "python/observables.hpp"

#include "python/buffers.hpp"

#include <carom/io/output_error.hpp>

#include <fmt/format.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <istream>
#include <iterator>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

// numpy reads collisions where they are: carom.observables.COLLISION has these places.
static_assert(sizeof(PairCollision) == 144 && offsetof(PairCollision, disk) == 8 && offsetof(PairCollision, separation) == 16 &&
              offsetof(PairCollision, impulse) == 32 && offsetof(PairCollision, velocity_before) == 48 &&
              offsetof(PairCollision, velocity) == 64 && offsetof(PairCollision, partner_velocity_before) == 80 &&
              offsetof(PairCollision, partner_velocity) == 96 && offsetof(PairCollision, contact) == 112);

class PythonObservable final : public Observable {
 public:
  PythonObservable(nb::object object, ObservableFailed failed)
      : object_(std::move(object)),
        failed_(std::move(failed)),
        name_(nb::cast<std::string>(object_.attr("name"))),
        step_(nb::cast<double>(object_.attr("step"))),
        needs_positions_(nb::cast<bool>(object_.attr("needs_positions"))),
        follows_collisions_(nb::cast<bool>(object_.attr("follows_collisions"))) {}
  PythonObservable(const PythonObservable&) = delete;
  PythonObservable& operator=(const PythonObservable&) = delete;
  ~PythonObservable() override {
    const nb::gil_scoped_acquire locked;
    object_.reset();
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] double step() const override { return step_; }
  [[nodiscard]] bool needs_positions() const override { return needs_positions_; }
  [[nodiscard]] bool follows_collisions() const override { return follows_collisions_; }

  void start(const State& state) override {
    const nb::gil_scoped_acquire locked;
    object_.attr("_start")(State(state));
  }
  void sample(const State& state, const Totals& totals) override {
    guarded([&] {
      hand_over();
      object_.attr("_sample")(State(state), totals.pair, totals.virial);
    });
  }
  void collisions(std::span<const PairCollision> collisions) override {
    if (broken_) return;
    waiting_->insert(waiting_->end(), collisions.begin(), collisions.end());
    if (waiting_->size() >= batch) guarded([&] { hand_over(); });
  }
  Measurement finish(double time, const Totals& totals) override;

  void save(std::ostream& out) const override {
    const nb::gil_scoped_acquire locked;
    const_cast<PythonObservable*>(this)->save_to(out);
  }
  void load(std::istream& in) override {
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const nb::gil_scoped_acquire locked;
    object_.attr("_load")(nb::bytes(bytes.data(), bytes.size()));
  }

 private:
  /// A call of Python takes as long as some ten collisions.
  static constexpr std::size_t batch = 4096;

  struct Shared {
    std::shared_ptr<std::vector<PairCollision>> collisions;
    [[nodiscard]] const PairCollision* data() const { return collisions->data(); }
  };

  /// Makes a call. What it throws is told; nothing is called from then on.
  template <class Call>
  void guarded(const Call& call) {
    if (broken_) return;
    const nb::gil_scoped_acquire locked;
    try {
      call();
    } catch (const std::exception&) {
      if (!failed_) throw;
      broken_ = true;
      failed_(std::current_exception());
    }
  }

  /// Does as finish(). Requires the lock.
  Measurement measured(double time, const Totals& totals);
  /// Does as save(). Requires the lock.
  void save_to(std::ostream& out);

  /// Hands on the collisions that wait. Their memory is used again where Python does not keep it. Requires the lock.
  void hand_over() {
    if (waiting_->empty()) return;
    const std::size_t bytes = waiting_->size() * sizeof(PairCollision);
    object_.attr("_collisions")(array_that_owns<std::uint8_t>(Shared{waiting_}, {bytes}));
    if (waiting_.use_count() > 1) waiting_ = std::make_shared<std::vector<PairCollision>>();
    waiting_->clear();
  }

  nb::object object_;
  ObservableFailed failed_;
  bool broken_ = false;  ///< it has thrown, perhaps in the middle of something
  std::string name_;
  double step_;
  bool needs_positions_, follows_collisions_;
  std::shared_ptr<std::vector<PairCollision>> waiting_ = std::make_shared<std::vector<PairCollision>>();
};

Measurement PythonObservable::finish(double time, const Totals& totals) {
  Measurement found{.name = name_};
  guarded([&] { found = measured(time, totals); });
  return found;
}

void PythonObservable::save_to(std::ostream& out) {
  const auto refuse = [this](const std::string& reason) {
    throw OutputError(fmt::format("the observable {} cannot be saved: {}", name_, reason));
  };
  guarded([this] { hand_over(); });
  if (broken_) refuse("it has failed");
  try {
    const auto bytes = nb::cast<nb::bytes>(object_.attr("_save")());
    out.write(bytes.c_str(), static_cast<std::streamsize>(bytes.size()));
  } catch (const nb::python_error& error) {
    refuse(fmt::format("{}: {}", nb::cast<std::string>(error.type().attr("__name__")), nb::str(error.value()).c_str()));
  } catch (const std::bad_cast&) {
    refuse("what it has saved is not of bytes");
  }
}

Measurement PythonObservable::measured(double time, const Totals& totals) {
  hand_over();
  using Scalars =
      std::vector<std::tuple<std::string, double, std::optional<double>, std::string, std::optional<double>, std::string>>;
  using Columns = std::vector<std::tuple<std::string, std::string, std::vector<double>>>;
  const auto [scalars, tables] = nb::cast<std::pair<Scalars, std::vector<std::pair<std::string, Columns>>>>(
      object_.attr("_finish")(time, totals.pair, totals.virial));
  Measurement measured{.name = name_};
  for (const auto& [scalar, value, error, unit, correlation_time, note] : scalars)
    measured.scalars.push_back({.name = scalar,
                                .unit = unit,
                                .value = value,
                                .error = error,
                                .integrated_correlation_time = correlation_time,
                                .note = note});
  for (const auto& [table, columns] : tables) {
    Table& made = measured.tables.emplace_back(Table{.name = table});
    for (const auto& [column, unit, values] : columns) made.columns.push_back({column, unit, values});
  }
  return measured;
}

nb::tuple tuple_of(const Measurement& measurement) {
  nb::list scalars, tables;
  for (const Scalar& scalar : measurement.scalars)
    scalars.append(
        nb::make_tuple(scalar.name, scalar.value, scalar.error, scalar.unit, scalar.integrated_correlation_time, scalar.note));
  for (const Table& table : measurement.tables) {
    nb::list columns;
    for (const Column& column : table.columns)
      columns.append(nb::make_tuple(column.name, column.unit, array_that_owns<double>(column.values, {column.values.size()})));
    tables.append(nb::make_tuple(table.name, columns));
  }
  return nb::make_tuple(measurement.name, measurement.note, scalars, tables);
}

}  // namespace

std::unique_ptr<Observable> observable_of(const nb::object& object, ObservableFailed failed) {
  return std::make_unique<PythonObservable>(object, std::move(failed));
}

nb::typed<nb::list, AnyTuple> tuples_of(const std::vector<Measurement>& measurements) {
  nb::list tuples;
  for (const Measurement& measurement : measurements) tuples.append(tuple_of(measurement));
  return nb::borrow<nb::typed<nb::list, AnyTuple>>(tuples);
}

}  // namespace carom::python
