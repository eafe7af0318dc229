#include "output/hdf5_handle.h"

#include <fmt/core.h>
#include <hdf5.h>

namespace thermotwin::output::hdf5 {
namespace {

herr_t take_innermost(unsigned depth, H5E_error2_t const* error, void* text) {
  if (depth == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

void fail(std::string const& what) {
  std::string reason = "HDF5 gives no reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &reason);
  throw Failure(fmt::format("{}: {}", what, reason));
}

Silence::Silence() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &client_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence() {
  H5Eset_auto2(H5E_DEFAULT, print_, client_);
  H5Eclear2(H5E_DEFAULT);
}

Handle fixed_text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  H5Tset_size(type, size);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Handle any_text_type() { return fixed_text_type(H5T_VARIABLE); }

}  // namespace thermotwin::output::hdf5
