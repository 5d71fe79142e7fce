#pragma once
// What all observables of the catalogue have in common: name and step, results with their errors, and that they can be written
// down in the middle of a run and read back.

#include "core/archive.hpp"
#include "observe/observed_run.hpp"

#include <carom/observe.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <utility>

namespace carom {

/// Returns the remark on an observable of places whose bins or cells end where walls were known to come (reach_of_walls); empty
/// where no disk was outside of them. `outside` of the `seen` disks of all samples were.
[[nodiscard]] inline std::string note_on_disks_outside(std::uint64_t outside, std::uint64_t seen) {
  if (outside == 0) return {};
  return fmt::format(
      "{:.3g} % of the disks were beyond the bins, behind walls that had moved further outward than was known "
      "when the run began",
      100.0 * static_cast<double>(outside) / static_cast<double>(seen));
}

/// `Self` derives from this, and lists what it has gathered in `template <class Archive> void serialize(Archive& archive)`. What
/// it is made with is not among it.
template <class Self>
class SavedObservable : public Observable {
 public:
  SavedObservable(const ObservableRequest& request, const ObservedRun& run)
      : run_(run), step_(run.step(request)), name_(request.name) {}

  [[nodiscard]] std::string name() const final { return name_; }
  [[nodiscard]] double step() const override { return step_; }

  void save(std::ostream& out) const final {
    SavingArchive archive(out);
    archive(static_cast<const Self&>(*this));
  }
  void load(std::istream& in) final {
    LoadingArchive archive(in);
    archive(static_cast<Self&>(*this));
  }

 protected:
  /// Adds a table to the results, or a note that the run was too short where it has no more columns than the first `heads`, which
  /// hold no results.
  static void put_table(Measurement& found, Table table, std::size_t heads = 0) {
    if (table.columns.size() <= heads)
      found.note = "the run is too short";
    else
      found.tables.push_back(std::move(table));
  }
  /// Adds a number to the results, as `series.fill(scalar, step, more...)` gives it, or `otherwise` as its note.
  template <class Series, class... More>
  void put(Measurement& found, Scalar scalar, const Series& series, const char* otherwise = "nothing was measured",
           More... more) const {
    series.fill(scalar, step_, more...);
    if (!scalar.value) scalar.note = otherwise;
    found.scalars.push_back(std::move(scalar));
  }

  ObservedRun run_;
  double step_;

 private:
  std::string name_;
};

}  // namespace carom
