#pragma once
// How a tool answers what is inside it: any of contact/responses/list.hpp.
#include "contact/responses/list.hpp"
#include "core/law_variant.hpp"

namespace cnem::contact {

/// Exact by default.
class Response {
public:
  Response() = default;
  template<class Law>
  requires requires { Law::parameters; }
  Response(const Law& law) : law_(law) {}

  bool exact() const { return is<Exact>(); }
  template<class Law> bool is() const { return std::holds_alternative<Law>(law_); }

  /// Of a response that is not exact, which pushes nothing here.
  template<int dim> Push<dim> push(const Intrusion<dim>& at) const {
    return std::visit(
        [&](const auto& law) {
          if constexpr (requires { law.push(at); })
            return law.push(at);
          else
            return Push<dim>{};
        },
        law_);
  }

  /// Largest stable step over that with exact contact.
  double step_share() const {
    return std::visit(
        [](const auto& law) {
          if constexpr (requires { law.step_share(); })
            return law.step_share();
          else
            return 1.0;
        },
        law_);
  }

private:
  VariantOf<Responses> law_;
};

} // namespace cnem::contact
