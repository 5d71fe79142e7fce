#pragma once
// Predictions for a disk: which of its neighbours it meets first, and when it leaves its neighbourhood. The hot question of
// the engine, answered for many neighbours at a time. One algorithm (prediction_kernel.hpp), compiled for every machine, for
// those with AVX2 and for those with AVX-512; all give the same bits, and which one runs is decided when the program starts.

#include "core/flight.hpp"

#include <cstdint>
#include <vector>

namespace carom {

struct PairStep;  // core/pair_step.hpp; kernels must not include its code

/// Data of a sheared box, whose images above slide past those below (effects/shear.hpp), for the kernel that supports it.
struct SlidingFrame {
  /// Heights of the centre of each disk's neighbourhood, in steps of 2^32. It tells in which box a disk is whose coordinate has
  /// wrapped; velocities are those of the disk in that box, and those of its images above and below are other ones.
  const std::int32_t* heights = nullptr;
  std::int64_t displacement = 0;  ///< displacement of the images above at the epoch, in steps of a coordinate
  double speed = 0.0;             ///< speed of the images above
  std::int64_t inner = 0;         ///< disks with neighbourhoods nearer to the middle than this meet no disk through an edge
};

/// Constants of all predictions of a run.
struct PredictionFrame {
  double unit[2];     ///< length of a step of a coordinate, per axis
  double steps[2];    ///< 1 / unit
  double sigma;       ///< contact distance of equal disks; unused where disks have sizes of their own
  double half_width;  ///< of a neighbourhood
  /// The time at which a disk leaves its neighbourhood is rounded down to steps of this length (a power of two; 0 for none). It
  /// is nothing physical, and with a time of few bits as `now` the predictions made then are exact for dyadic data.
  double edge_step = 0.0;
  double scale = 1.0;             ///< scale of all radii at the epoch; beyond 1 only for the kernel of growing disks
  double expansion = 0.0;         ///< of the scale, per time
  double reach = 1.0;             ///< of the pair potential over the hard diameter; beyond 1 only for the kernel of steps
  std::int32_t outside = 0;       ///< for the kernel of steps: the number of steps
  const double* edges = nullptr;  ///< for the kernel of steps: widths of the core and of all steps, over the hard diameter
  const std::vector<PairStep>* pair_steps = nullptr;  ///< for the kernel of steps: for each disk, its partners within them
  SlidingFrame sliding = {};
  /// For disks whose diameters are not additive: contact distances over sums of radii, a row of `kinds` for each species.
  const double* contact_scales = nullptr;
  std::int32_t kinds = 0;
};

/// The kind of motion and interaction that a prediction kernel supports: hard cores, falling hard cores, growing hard cores, hard
/// cores within steps of a potential (which may fall too), or hard cores in a sheared box. Falling does not change the relative
/// motion of a pair, but height is energy: where other engines begin a new line at the next step of a coordinate towards the old
/// line, falling disks' lines are rounded to nearest.
enum class PredictionKind { hard, falling, growing, steps, falling_steps, sheared };

/// The neighbourhood of a disk: a square round `centre` (in steps of 2^32 of a coordinate), and the ids of the disks that it may
/// meet there, padded with its own id, with which it never collides, to eight at least and to a multiple of four; after a
/// collision to twelve at least.
struct Surroundings {
  std::int32_t centre[2];
  const std::int32_t* ids;
  std::uint32_t count;
};

/// Times since the epoch; infinity for never. Not side by side: both copied in one piece, a compiler's choice, would have to wait
/// until the later of them has left the processor.
struct Prediction {
  double pair_time;
  std::int32_t partner;  ///< -1 where there is none
  std::int32_t tied;     ///< not 0: another partner comes at the very same time
  double edge_time;      ///< when the disk leaves its neighbourhood; not before now
};

/// Two disks that have just collided: what surrounds them, and (to be filled in) what lies ahead of them.
struct CollidedPair {
  std::int32_t disk[2];
  Surroundings around[2];
  Prediction ahead[2];
  unsigned wrapped;  ///< a bit for each coordinate, x and y of the one, x and y of the other, that went past the end of its range
  unsigned downwards;  ///< a bit for each that became smaller, but for wrapping
};

template <class Line>
struct PredictionKernel {
  /// Disk i from `now` on.
  void (*predict)(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around, double now,
                  Prediction& ahead);
  /// Changes the velocities of the disks a and b of a pair from time `now` on: draws their new lines, which at `now` are where
  /// the old ones are, then predicts both. No coordinate may change by half its range. (Storing here, in one piece, lets the
  /// loads that follow read what has just been written.)
  void (*turn_and_predict)(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, double avx, double avy,
                           double bvx, double bvy);
  const char* name;  ///< name of the instruction set, or "sheared" or "steps"
};

/// Returns the best kernel for this machine; see core/instructions.hpp. That of steps is the same on all.
template <class Line>
const PredictionKernel<Line>& prediction_kernel(PredictionKind kind = PredictionKind::hard);

}  // namespace carom
