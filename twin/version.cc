#include "twin/version.h"

#include "twin/version.inc"

namespace thermotwin::twin {

std::string_view version() { return THERMOTWIN_VERSION; }
std::string_view commit() { return THERMOTWIN_COMMIT; }
std::string_view sources() { return THERMOTWIN_SOURCES; }

}  // namespace thermotwin::twin
