#include "diagnosis/files/stored_columns.hpp"

#include <utility>

namespace wormdrive {

std::vector<StoredNumbers> with_stated_units(StoredContents contents) {
  for (StoredNumbers& column : contents.columns)
    for (const auto& [table, text] : {std::pair{"units.", &column.unit}, {"meanings.", &column.comment}})
      if (const auto stated = contents.texts.find(table + column.name); text->empty() && stated != contents.texts.end())
        *text = stated->second;
  std::erase_if(contents.columns, [&](const StoredNumbers& column) {
    return contents.texts.contains(column.name) &&
           (column.name.starts_with("units.") || column.name.starts_with("meanings."));
  });
  return std::move(contents.columns);
}

void append_character(std::string& text, std::uint16_t character) {
  const auto add = [&](int byte) { text += static_cast<char>(byte); };
  if (character < 0x80) {
    add(character);
  } else if (character < 0x800) {
    add(0xc0 | character >> 6);
    add(0x80 | (character & 0x3f));
  } else {
    add(0xe0 | character >> 12);
    add(0x80 | (character >> 6 & 0x3f));
    add(0x80 | (character & 0x3f));
  }
}

}  // namespace wormdrive
