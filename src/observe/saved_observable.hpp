#pragma once
// An observable that can be written down in the middle of a run and read back.

#include "core/archive.hpp"

#include <carom/observe.hpp>

#include <istream>
#include <ostream>

namespace carom {

/// `Self` derives from this, and lists what it has gathered in `template <class Archive> void serialize(Archive& archive)`. What
/// it is made with is not among it.
template <class Self>
class SavedObservable : public Observable {
 public:
  void save(std::ostream& out) const final {
    SavingArchive archive(out);
    archive(static_cast<const Self&>(*this));
  }
  void load(std::istream& in) final {
    LoadingArchive archive(in);
    archive(static_cast<Self&>(*this));
  }
};

}  // namespace carom
