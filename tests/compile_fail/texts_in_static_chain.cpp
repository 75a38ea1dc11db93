// expect: error: .*kte: a static chain is connected by keys
#include <kte/elements/revolute_joint.hpp>
#include <kte/static_chain/static_chain.hpp>

const auto pendulum = kte::chain(kte::revolute_joint_2D("q", "base", "joint"));
