#include "explanation/warnings.h"

#include "data/text.h"
#include "explanation/wording.h"

namespace uncertainty_identification {

const char* const kNothingHeldOut =
    "too few experiments to hold any out of the fit: gains are measured on those fitted to, "
    "which makes them too large; record four or more, or give others by --validation";

const char* const kMayBeFeedback =
    "the input may depend on the output (closed loop), which would bias the model; the residuals "
    "depend on the earlier input, too, so that the data do not clearly show it";

const char* const kOutOfTime =
    "the search ended at explanation.time_limit, before all causes were tried; give it more time, "
    "or fewer or shorter experiments";

const char* const kLineAsPoles =
    "a model of higher orders is as likely, by two poles that nothing damps; these are left out of "
    "the "
    "model, because an oscillation that nothing damps comes from outside";

std::string quantisationRemark(double step, double share) {
  return "the sensor reads in steps of " + rounded(step) + " (unit of y), which make up " +
         rounded(100 * share) + " % of the noise variance";
}

const char* const kFeedback =
    "the input depends on the output (closed loop): the estimates are consistent only if the noise "
    "model is right";

namespace {

std::vector<std::string> ofRefusals(const SearchOutcome& best) {
  std::vector<std::string> causes;
  for (const FoundCause& cause : best.found.causes) causes.push_back(cause.effect->label());
  return best.refusals.warnings(causes);
}

/// Empty where the likelihood asks for the orders that the simulation chose, an orderText().
std::string ofOrders(const std::string& chosen, const Estimate& explained) {
  const std::string after = orderText(explained);
  if (chosen == after) return "";
  return "nominal_model.orders: auto chose " + chosen +
         " by the error of simulations; the likelihood of all experiments "
         "asks for " +
         after + ", and that model is explained";
}

/// Empty where on top of the other orders no other causes explain the data as well.
std::string ofTie(const SearchOutcome& other, const SearchOutcome& best) {
  if (other.penalisedLikelihood() <= best.penalisedLikelihood() ||
      other.found.causes.size() <= best.found.causes.size())
    return "";
  std::string names;
  for (const FoundCause& cause : other.found.causes)
    names += (names.empty() ? "" : " and ") + named(*cause.effect);
  return "with " + orderText(other.estimate) + ", " + names +
         " would explain the data as well as the orders above; if you know "
         "the orders, give them: nominal_model.na, nb, nc, nd, delay";
}

}  // namespace

std::vector<std::string> warningsOf(const SearchOutcome& best,
                                    const std::vector<SearchOutcome>& outcomes) {
  std::vector<std::string> all{best.simplification, best.base.remark,
                               ofOrders(best.chosen_orders, best.estimate)};
  for (const SearchOutcome& other : outcomes) all.push_back(ofTie(other, best));
  for (const std::string& warning : ofRefusals(best)) all.push_back(warning);
  return all;
}

}  // namespace uncertainty_identification
