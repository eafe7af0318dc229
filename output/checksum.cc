#include "output/checksum.h"

#include <zlib.h>

namespace thermotwin::output {

std::uint32_t crc_32(std::string_view bytes) {
  return std::uint32_t(crc32_z(0, reinterpret_cast<Bytef const*>(bytes.data()), bytes.size()));
}

}  // namespace thermotwin::output
