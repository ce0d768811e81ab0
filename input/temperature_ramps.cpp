#include "input/temperature_ramps.hpp"

#include "input/schema/document_walk.hpp"
#include "input/schema/schema.hpp"

namespace cnem::input {

void start_temperature_ramps(Value& document) {
  const Member* initial = document.find("initial");
  const Member* given = initial ? initial->value.find("temperature") : nullptr;
  const Value start =
      given ? given->value
            : parse_document("value = " + find_key("initial.temperature")->fallback, "").find("value")->value;
  for (const Key& key : schema())
    if (key.type == Type::function && key.dimension == dimension::temperature)
      for_each_at(document, key.path, "", [&](Value& ramp, const std::string&) {
        if (ramp.find("ramp") && !ramp.find("from")) ramp.members.push_back({"from", ramp.where, start});
      });
}

} // namespace cnem::input
