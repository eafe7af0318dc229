#pragma once

#include <cstdint>
#include <string_view>

namespace thermotwin::output {

/// CRC-32 (ISO 3309, as in zip and PNG).
[[nodiscard]] std::uint32_t crc_32(std::string_view bytes);

}  // namespace thermotwin::output
