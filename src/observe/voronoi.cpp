// Voronoi cells of the centres: sixfold order with sides as weights, numbers of neighbours and areas.
//
// psi_j = sum over the sides of cell j of (length / perimeter) exp(6 i theta), theta the direction to the neighbour there. Unlike
// the order of the six nearest, or of all neighbours alike, it changes continuously as disks move: a neighbour comes and goes
// with a side of length 0 (Mickel, Kapfer, Schroeder-Turk & Mecke, J. Chem. Phys. 138, 044501 (2013)). Averages over time. Cells
// that a wall cuts off count in areas alone. In a sheared box the images above are where they are at the time of the sample.

#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/voronoi_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace carom {

namespace {

class Voronoi final : public SavedObservable<Voronoi> {
 public:
  Voronoi(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        areas_(static_cast<std::size_t>(request.bins.value_or(100))),
        fractions_(most_sides - least_sides + 1),
        area_of_sides_(fractions_.size()) {}

  void sample(const State& state, const Totals&) override {
    const Box box = box_of(run_.scene.box, state);
    const VoronoiCells cells(box, state.positions, state.shear_displacement);
    const double mean_area = box.area() / static_cast<double>(cells.count());
    std::complex<double> global = 0.0, global_of_areas = 0.0, global_of_neighbours = 0.0;
    double whole = 0.0, local = 0.0, square = 0.0, local_of_neighbours = 0.0, perimeters = 0.0, area_of_whole = 0.0,
           variance = 0.0;
    std::vector<double> in_bin(areas_.size()), with_sides(fractions_.size()), area_with_sides(fractions_.size());
    for (std::size_t i = 0; i < cells.count(); ++i) {
      const double area = cells.area(i) / mean_area;
      variance += (area - 1.0) * (area - 1.0);
      const auto bin = static_cast<std::size_t>(std::max(0.0, area) / (largest_area / static_cast<double>(in_bin.size())));
      if (bin < in_bin.size()) in_bin[bin] += 1.0;
      if (cells.at_wall(i)) continue;
      const auto sides = cells.sides(i);
      const std::complex<double> by_length = sixfold_order(sides);
      std::vector<VoronoiSide> equal(sides.begin(), sides.end());
      double perimeter = 0.0;
      for (VoronoiSide& side : equal) perimeter += std::exchange(side.length, 1.0);
      const std::complex<double> alike = sixfold_order(equal);
      whole += 1.0, area_of_whole += area, perimeters += perimeter;
      local += std::abs(by_length), square += std::norm(by_length), local_of_neighbours += std::abs(alike);
      global += by_length, global_of_areas += area * by_length, global_of_neighbours += alike;
      const std::size_t row = std::clamp(sides.size(), least_sides, most_sides) - least_sides;
      with_sides[row] += 1.0;
      area_with_sides[row] += area;
    }
    const auto count = static_cast<double>(cells.count());
    area_variance_.add(variance / count);
    for (std::size_t b = 0; b < in_bin.size(); ++b) areas_.add(b, in_bin[b] / count);
    local_.add(local, whole), local_square_.add(square, whole), local_of_neighbours_.add(local_of_neighbours, whole);
    perimeter_.add(perimeters, whole);
    for (std::size_t row = 0; row < with_sides.size(); ++row) {
      fractions_.add(row, with_sides[row], whole);
      area_of_sides_.add(row, area_with_sides[row], with_sides[row]);
    }
    if (whole == 0.0) return;  // in a narrow channel all cells are at walls
    global_.add(std::abs(global) / whole);
    global_square_.add(std::norm(global) / (whole * whole));
    global_of_areas_.add(std::abs(global_of_areas) / area_of_whole);
    global_of_neighbours_.add(std::abs(global_of_neighbours) / whole);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    const char* const none = "all cells are at walls";
    put(found, {.name = "local"}, local_, none);
    put(found, {.name = "local_square"}, local_square_, none);
    put(found, {.name = "global"}, global_, none);
    put(found, {.name = "global_square"}, global_square_, none);
    put(found, {.name = "global_by_area"}, global_of_areas_, none);
    put(found, {.name = "local_unweighted"}, local_of_neighbours_, none);
    put(found, {.name = "global_unweighted"}, global_of_neighbours_, none);
    constexpr std::array<const char*, 3> names = {"fraction_5", "fraction_6", "fraction_7"};
    for (std::size_t k = 0; k < names.size(); ++k) put(found, {.name = names[k]}, fractions_.row(k + 5 - least_sides), none);
    put(found, {.name = "perimeter", .unit = "length"}, perimeter_, none);
    put(found, {.name = "area_variance"}, area_variance_);
    found.tables = {neighbours(), areas()};
    note_lower_bounds(found, fractions_.has_lower_bounds() || area_of_sides_.has_lower_bounds() || areas_.has_lower_bounds());
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(areas_, fractions_, area_of_sides_, local_, local_square_, global_, global_square_, global_of_areas_,
            local_of_neighbours_, global_of_neighbours_, perimeter_, area_variance_);
  }

 private:
  static constexpr std::size_t least_sides = 3, most_sides = 12;
  static constexpr double largest_area = 4.0;  ///< of the histogram, in mean areas

  [[nodiscard]] Table neighbours() const {
    Table table{.name = "voronoi_neighbours"};
    table.columns.push_back({"neighbours", "", {}});
    for (std::size_t z = least_sides; z <= most_sides; ++z) table.columns[0].values.push_back(static_cast<double>(z));
    fractions_.put(table, "fraction", "");
    area_of_sides_.put(table, "area", "");
    return table;
  }

  [[nodiscard]] Table areas() const {
    Table table{.name = "voronoi_areas"};
    table.columns.push_back({"area", "", {}});
    const double width = largest_area / static_cast<double>(areas_.size());
    for (std::size_t b = 0; b < areas_.size(); ++b) table.columns[0].values.push_back((static_cast<double>(b) + 0.5) * width);
    areas_.put(table, "density", "", 1.0 / width);
    return table;
  }

  BlockedColumn areas_, fractions_, area_of_sides_;
  Blocking local_, local_square_, global_, global_square_, global_of_areas_, local_of_neighbours_, global_of_neighbours_;
  Blocking perimeter_, area_variance_;
};

}  // namespace

MadeObservable make_voronoi(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Voronoi>(request, run);
}

}  // namespace carom
