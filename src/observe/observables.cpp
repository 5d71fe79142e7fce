#include "observe/observables.hpp"

#include "scene/checks.hpp"
#include "scene/refusal.hpp"

namespace carom {

namespace {

struct Entry {
  const char* name;
  MadeObservable (*make)(const ObservableRequest& request, const ObservedRun& run);
};
constexpr Entry catalogue[] = {
    {"temperature", &make_temperature},
    {"pressure", &make_pressure},
    {"collision_rate", &make_collision_rate},
    {"contact_values", &make_contact_values},
    {"free_flight", &make_free_flight},
    {"speeds", &make_speeds},
    {"velocity_moments", &make_velocity_moments},
    {"radial_distribution", &make_radial_distribution},
    {"structure_factor", &make_structure_factor},
    {"hexatic", &make_hexatic},
    {"voronoi", &make_voronoi},
    {"clusters", &make_clusters},
    {"density_profile", &make_density_profile},
    {"fields", &make_fields},
    {"mean_square_displacement", &make_mean_square_displacement},
    {"intermediate_scattering", &make_intermediate_scattering},
    {"overlap", &make_overlap},
    {"non_gaussian", &make_non_gaussian},
    {"van_hove", &make_van_hove},
    {"velocity_autocorrelation", &make_velocity_autocorrelation},
    {"viscosity", &make_viscosity},
    {"heat_conductivity", &make_heat_conductivity},
    {"h_function", &make_h_function},
    {"wall_fluxes", &make_wall_fluxes},
    {"work", &make_work},
};

}  // namespace

MadeObservable make_observable(const ObservableRequest& request, const ObservedRun& run) {
  ObservableRequest completed = request;  // a program may leave open what the reader of files fills in
  detail::complete_request(run.scene, completed);
  for (const Entry& entry : catalogue)
    if (request.name == entry.name) return entry.make(completed, run);
  throw detail::scene_error(run.scene, "observe." + request.name, "there is no observable \"" + request.name + "\"");
}

}  // namespace carom
