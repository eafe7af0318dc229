#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

/// What the writing and the reading half of the HDF5 seam share; for output/hdf5_*.cc only.
namespace thermotwin::output::hdf5 {

using Id = std::int64_t;  ///< HDF5's hid_t, without its header

/// What HDF5 says about a call that failed; without a file name, which the caller knows.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Failure with HDF5's innermost reason.
[[noreturn]] void fail(std::string const& what);

/// Of a call that returns less than zero when it fails.
inline void expect(int status, std::string const& what) {
  if (status < 0) fail(what);
}

/// Owns one HDF5 object.
class Handle {
 public:
  Handle(Id id, int (*close)(Id), std::string const& what) : id_(id), close_(close) {
    if (id < 0) fail(what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(Handle const&) = delete;
  Handle& operator=(Handle const&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator Id() const { return id_; }  // NOLINT(google-explicit-constructor): it is passed to every H5 call

 private:
  Id id_;
  int (*close_)(Id);
};

/// HDF5 prints its errors unless told otherwise; while this lives they only become exceptions. None stays on the stack
/// of the thread, without which the library could not end.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(Silence const&) = delete;
  Silence& operator=(Silence const&) = delete;

 private:
  int (*print_)(Id, void*) = nullptr;
  void* client_ = nullptr;
};

/// UTF-8 text of `size` bytes, or of any length.
Handle fixed_text_type(std::size_t size);
Handle any_text_type();

}  // namespace thermotwin::output::hdf5
