#pragma once
// The catalogue of observables: one function, and one file, for each key of the [observe] table.

#include "observe/followers.hpp"
#include "observe/observed_run.hpp"

#include <carom/observe.hpp>

#include <memory>
#include <type_traits>
#include <utility>

namespace carom {

/// An observable, and what it needs of collisions where that is less than all of them.
struct MadeObservable {
  template <class Made>
  MadeObservable(std::unique_ptr<Made> made) {  // NOLINT(google-explicit-constructor): what std::make_unique returns
    if constexpr (std::is_base_of_v<FluxFollower, Made>) fluxes = made.get();
    if constexpr (std::is_base_of_v<RecordFollower, Made>) records = made.get();
    if constexpr (std::is_base_of_v<ChangeFollower, Made>) changes = made.get();
    observable = std::move(made);
  }

  std::unique_ptr<Observable> observable;
  FluxFollower* fluxes = nullptr;
  RecordFollower* records = nullptr;
  ChangeFollower* changes = nullptr;
};

MadeObservable make_temperature(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_pressure(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_collision_rate(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_contact_values(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_free_flight(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_speeds(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_velocity_moments(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_radial_distribution(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_structure_factor(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_hexatic(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_voronoi(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_clusters(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_density_profile(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_fields(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_mean_square_displacement(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_intermediate_scattering(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_overlap(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_non_gaussian(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_van_hove(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_velocity_autocorrelation(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_viscosity(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_heat_conductivity(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_h_function(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_wall_fluxes(const ObservableRequest& request, const ObservedRun& run);
MadeObservable make_work(const ObservableRequest& request, const ObservedRun& run);

/// Makes the observable that a scene asks for. Throws SceneError where there is none of that name.
[[nodiscard]] MadeObservable make_observable(const ObservableRequest& request, const ObservedRun& run);

}  // namespace carom
