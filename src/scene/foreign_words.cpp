#include "scene/foreign_words.hpp"

#include <array>
#include <cctype>
#include <string>

namespace carom::detail {
namespace {

struct Meaning {
  std::string_view clause;
  std::string_view words;  ///< between blanks, in small letters without _ and -, but for those of one letter
};

constexpr std::array<Meaning, 13> meanings = {{
    {"events need no time step; the time between samples is sample_every in [run]",
     " dt deltat timestep step stepsize h saveevery saveinterval sampleinterval outputevery outputinterval "
     "dumpevery "},
    {"events need no steps; a run is as long as time or collisions in [run] says",
     " steps nsteps numsteps maxsteps timesteps iterations niter t tmax tend tfinal endtime totaltime runtime "
     "duration "},
    {"disks are described in [[disks]], where their number is count",
     " N n num number nparticles numparticles ndisks numdisks nballs natoms particles particle balls atoms "},
    {"the temperature is that of velocities = { temperature = 1.0 } in [[disks]], or of a [thermostat]", " T temp kt kbt "},
    {"the size of the box is given by x = [0.0, 10.0] and y = [0.0, 10.0] in [box]",
     " L l lx ly boxsize boxlength sidelength size length width height domain "},
    {"the size of a disk is radius in [[disks]], half its diameter", " r R d sigma diameter radii "},
    {"the mass of a disk is mass in [[disks]]", " m masses "},
    {"where disks start is positions in [[disks]]", " pos r0 x0 coords coordinates "},
    {"how disks start to move is velocities in [[disks]]", " v vel v0 "},
    {"the share of the box that disks cover is packing_fraction in [[disks]]",
     " phi eta density rho areafraction volumefraction packing "},
    {"the coefficient of restitution is restitution in [collision]", " e cor coefficientofrestitution "},
    {"gravity is acceleration = [0.0, -9.81] in [gravity]", " g "},
    {"walls or periodic edges are boundary in [box]", " pbc bc bcs boundaryconditions periodic "},
}};

}  // namespace

std::string_view meant_by(std::string_view word) {
  std::string plain;
  for (const char c : word) {
    if (c == '_' || c == '-') continue;
    plain += word.size() == 1 ? c : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  plain = " " + plain + " ";
  for (const Meaning& meaning : meanings) {
    if (meaning.words.find(plain) != std::string_view::npos) return meaning.clause;
  }
  return {};
}

}  // namespace carom::detail
