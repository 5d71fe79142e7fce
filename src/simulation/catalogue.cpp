#include "simulation/catalogue.hpp"

#include "core/real.hpp"

namespace carom::detail {

extern template std::unique_ptr<AnyEngine> make_textbook<float>(const Scene&, const Start&);
extern template std::unique_ptr<AnyEngine> make_textbook<double>(const Scene&, const Start&);
extern template std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene&, const Start&);
extern template std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Start&);

const std::vector<EngineEntry>& catalogue() {
  static const std::vector<EngineEntry> entries = {
      {"textbook", "double precision (53 bits)", &make_textbook<double>},
      {"textbook-float", "single precision (24 bits)", &make_textbook<float>},
      {"textbook-long-double", "extended precision (64 bits)", &make_textbook<long double>},
      {"textbook-quad", "quadruple precision (113 bits)", &make_textbook<Quad>},
  };
  return entries;
}

}  // namespace carom::detail
