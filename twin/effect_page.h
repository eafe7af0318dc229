#pragma once

#include <string>

#include "twin/effect.h"
#include "twin/machine_tables.h"

/// What people read of the effect catalogue and of the tables of a file: all of it from the records that the reader of
/// the file uses, so that it cannot differ from what the program does. At most 100 columns wide.
namespace thermotwin::twin {

/// One effect: meaning, equation, what it changes, places, signature, what looks like it and how to tell, how diagnosis
/// tries it, source, and a table of its parameters.
[[nodiscard]] std::string effect_page(Effect const& effect);

/// A line for each effect of the catalogue.
[[nodiscard]] std::string effect_list();

/// The whole catalogue in Markdown: docs/effects.md.
[[nodiscard]] std::string effects_markdown();

/// One table of a machine or experiment file and its fields.
[[nodiscard]] std::string table_page(TableRecord const& table);

}  // namespace thermotwin::twin
