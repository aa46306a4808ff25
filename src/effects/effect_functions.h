#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "uncertainty_identification/effects/effect.h"

/// What the definitions of the catalogue's effects share.
namespace uncertainty_identification {

/// What Effect::apply() and Effect::feedback() of an effect do.
using ChainFunction = std::function<void(const Eigen::VectorXd& psi, Chain* chain)>;
using FeedbackFunction =
    std::function<Lanes(const Eigen::VectorXd& psi, const Lanes& x, const Lanes& before)>;

/// An effect that changes signals of the chain by one function and needs nothing else.
std::shared_ptr<Effect> chainEffect(EffectDescription description, ChainFunction apply);

/// An effect in the plant's loop (Stage::loop).
std::shared_ptr<Effect> loopEffect(EffectDescription description, FeedbackFunction feedback);

/// Starting values of an effect with one parameter: quantiles of sorted values, but none below
/// `lowest`.
std::vector<Eigen::VectorXd> quantileStarts(const Eigen::VectorXd& sorted,
                                            const std::vector<double>& probabilities,
                                            double lowest);

/// The parameter of effects that begin at an unknown instant of each experiment. The likelihood
/// is not smooth in it.
EffectParameter instantParameter(const DataSummary& data);

/// Starting values of effects with the parameters (size, instant): each size at nine instants
/// spread evenly over the longest experiment.
std::vector<Eigen::VectorXd> instantStarts(const std::vector<double>& sizes,
                                           const DataSummary& data);

/// A row vector that is 0 before `first` [samples] and 1 from there on; where `first` lies between
/// two samples, the later one has a value in between.
Eigen::Array<double, 1, Eigen::Dynamic> stepFrom(double first, const Chain& chain);

}  // namespace uncertainty_identification
