#include "description/toml/read_effects.hpp"

#include <fmt/format.h>

#include "description/rejection.hpp"
#include "description/toml/read_pairs.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {
void read_effects(TableReader& root, Scenario& scenario, const std::string& folder, Purpose purpose) {
  root.section("effect", [&](TableReader& effects) {
    scenario.effects.for_each([&]<class Effect>(std::optional<Effect>& effect) {
      const toml::table* table = effects.table(std::string(Effect::id));
      if (!table) return;
      TableReader reader(table, fmt::format("effect.{}", Effect::id), scenario.axis, root.faults(), effects.where());
      const bool on = reader.truth("on").value_or(true);
      Effect parameters;
      read_parameters(reader, parameters, folder);
      reader.finish();
      if (on) effect = parameters;
    });
    if (purpose == Purpose::show || !root.faults().empty()) return;
    for (const EffectRejection& refusal : effect_rejections(scenario)) effects.fault(refusal.id, refusal.what);
  });
}

}  // namespace wormdrive
