#pragma once
// Constants that libraries declare (core/parameter.hpp): their keys in the schema, and their reading.
#include "core/error.hpp"
#include "core/parameter.hpp"
#include "input/keys/keys.hpp"
#include "input/schema/settings.hpp"

#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace cnem::input {

/// A constant and the initial value of its member, or a list of them.
struct ConstantText {
  ParameterInfo info;
  double initial;
  bool list = false;
};

struct LawText {
  std::string name, formula, source;
  std::vector<ConstantText> constants;
};

template<class Owner> std::vector<ConstantText> constant_texts(std::span<const Parameter<Owner>> parameters) {
  std::vector<ConstantText> texts;
  for (const Parameter<Owner>& parameter : parameters)
    texts.push_back({parameter.info, Owner{}.*parameter.value});
  return texts;
}

template<class Owner> std::vector<ConstantText> list_texts() {
  std::vector<ConstantText> texts;
  for (const ListParameter<Owner>& list : Owner::lists) texts.push_back({list.info, infinite, true});
  return texts;
}

/// Constants of a law, its lists before the others.
template<class Law> std::vector<ConstantText> law_constant_texts() {
  std::vector<ConstantText> texts;
  if constexpr (requires { Law::lists; }) texts = list_texts<Law>();
  for (const ConstantText& text : constant_texts<Law>(Law::parameters)) texts.push_back(text);
  return texts;
}

template<class... Law> std::vector<LawText> law_texts(Laws<Law...>) {
  return {LawText{Law::name, Law::formula, Law::source, law_constant_texts<Law>()}...};
}

/// Keys of constants in the table `at`.
void add_constants(Keys& k, const std::string& at, const std::vector<ConstantText>& constants);

/// The key `at`.law, which chooses among the laws.
KeyDraft add_law_choice(Keys& k, const std::string& at, const std::vector<LawText>& laws);

/// Keys of all constants of the laws in the table `at`, each with the laws that have it. Throws
/// std::logic_error when two laws mean different things by one name.
void add_law_constants(Keys& k, const std::string& at, const std::vector<LawText>& laws);

/// Takes the constants that the table gives; others keep their values.
template<class Owner>
void read_constants(std::span<const std::type_identity_t<Parameter<Owner>>> parameters, const Setting& table,
                    Owner& owner) {
  for (const Parameter<Owner>& parameter : parameters)
    if (const auto value = table.maybe<double>(parameter.info.name)) owner.*parameter.value = *value;
}

/// Takes a list, if the table gives it. One that is too long is a mistake: then false.
bool read_list(const ParameterInfo& info, const Setting& table, NumberList& list, Diagnostics& diagnostics);

/// Takes the lists that the table gives and works out what follows; where they do not fit the first one is
/// named.
template<class Owner> void read_lists(const Setting& table, Owner& owner, Diagnostics& diagnostics) {
  const Setting* first = nullptr;
  for (const ListParameter<Owner>& list : Owner::lists) {
    if (!read_list(list.info, table, owner.*list.value, diagnostics)) return;
    if (!first) first = table.find(list.info.name);
  }
  try {
    owner.complete();
  } catch (const InputError& error) {
    diagnostics.add(Mistake::range, first->where, first->path, error.what());
  }
}

void check_order(const Order& order, const Setting& table, Diagnostics& diagnostics);
void check_strength(const std::vector<std::string>& names, const Setting& table, Diagnostics& diagnostics);

/// What the law says of its constants together.
template<class Law> void check_constants(const Setting& table, Diagnostics& diagnostics) {
  if constexpr (requires { Law::orders; })
    for (const Order& order : Law::orders) check_order(order, table, diagnostics);
  if constexpr (requires { Law::strength; })
    check_strength({std::begin(Law::strength), std::end(Law::strength)}, table, diagnostics);
}

/// The law that `table`.law names, with its constants. Result can be made of any of them.
template<class Result, class... Law>
std::optional<Result> read_law(Laws<Law...>, const Setting& table, Diagnostics& diagnostics) {
  const auto& name = table.get<std::string>("law");
  std::optional<Result> result;
  const auto try_law = [&]<class One>(std::type_identity<One>) {
    if (name != One::name) return;
    One law;
    read_constants(One::parameters, table, law);
    const Setting* where = &table;
    bool whole = true;
    if constexpr (requires { One::lists; }) {
      for (const ListParameter<One>& list : One::lists)
        whole &= read_list(list.info, table, law.*list.value, diagnostics);
      if (const Setting* first = table.find(One::lists[0].info.name)) where = first;
    }
    if (!whole) return;
    try {
      result = law;
    } catch (const InputError& error) {
      diagnostics.add(Mistake::range, where->where, where->path, error.what());
    }
    check_constants<One>(table, diagnostics);
  };
  (try_law(std::type_identity<Law>{}), ...);
  return result;
}

} // namespace cnem::input
