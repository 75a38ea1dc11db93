// expect: error: .*kte: a static chain is connected by keys
#include <kte/chain/static_chain.hpp>
#include <kte/elements/revolute_joint.hpp>

const auto pendulum = kte::chain(kte::revolute_joint_2D("q", "base", "joint"));
