#include "simulation/catalogue.hpp"

#include "core/real.hpp"

namespace carom::detail {

extern template std::unique_ptr<AnyEngine> make_textbook<float>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Disks&, State);

namespace {

bool always(const Scene& /*scene*/, const Disks& /*disks*/) { return true; }

}  // namespace

const std::vector<EngineEntry>& catalogue() {
  static const std::vector<EngineEntry> entries = {
      {"fast", &fast_covers, &make_fast},
      {"general", &general_covers, &make_general},
      {"textbook", &always, &make_textbook<double>},
      {"textbook-float", &always, &make_textbook<float>},
      {"textbook-long-double", &always, &make_textbook<long double>},
      {"textbook-quad", &always, &make_textbook<Quad>},
  };
  return entries;
}

}  // namespace carom::detail
