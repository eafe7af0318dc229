#include "output/hdf5_reading.h"

#include <hdf5.h>

namespace thermotwin::output::hdf5 {
namespace {

herr_t take_name(hid_t /*group*/, char const* name, H5L_info_t const* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

std::string read_text(Id type, std::function<int(Id, void*)> const& read_into) {
  if (H5Tget_class(type) != H5T_STRING) return {};
  if (H5Tis_variable_str(type) > 0) {
    char* bytes = nullptr;
    auto const memory_type = any_text_type();
    expect(read_into(memory_type, &bytes), "text");
    std::string const text = bytes ? bytes : "";
    H5free_memory(bytes);
    return text;
  }
  std::string text(H5Tget_size(type), '\0');
  expect(read_into(type, text.data()), "text");
  return text.substr(0, text.find('\0'));
}

std::string read_text_of(Id attribute) {
  Handle const type(H5Aget_type(attribute), H5Tclose, "type");
  return read_text(type, [&](Id as, void* into) { return H5Aread(attribute, as, into); });
}

std::string text_attribute(Id object, char const* name) {
  if (H5Aexists(object, name) <= 0) return {};
  return read_text_of(Handle(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name));
}

Handle open_variable(Id group, std::string const& name) {
  return {H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

std::vector<std::string> read_names(Id group, std::string const& name) {
  auto const variable = open_variable(group, name);
  Handle const space(H5Dget_space(variable), H5Sclose, name);
  auto const type = any_text_type();
  std::vector<char*> texts(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  expect(H5Dread(variable, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()), name);
  std::vector<std::string> names;
  for (char* text : texts) {
    names.emplace_back(text ? text : "");  // null where nothing was written
    H5free_memory(text);
  }
  return names;
}

std::vector<std::string> names_in(Id group) {
  std::vector<std::string> names;
  if (H5Literate(group, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, take_name, &names) >= 0) return names;
  names.clear();
  expect(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, take_name, &names), "names");
  return names;
}

}  // namespace thermotwin::output::hdf5
