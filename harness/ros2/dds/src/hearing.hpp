// What the node hears: from messages to events of the application and places of the body.
#ifndef CROSSGUARD_DDS_HEARING_HPP
#define CROSSGUARD_DDS_HEARING_HPP

#include <optional>
#include <stdexcept>
#include <string>

#include "crossguard.hpp"
#include "dds.hpp"
#include "telling.hpp"

// Why a message means nothing.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What a command tells the robot; nothing for SHOW, JOB and SERVE, which `describe` takes.
// Throws `Refusal`.
std::optional<crossguard::Event> event(const ros::Command &command, const Site &site);

// Has the body show, be there for and serve what the command says. Throws `Refusal`.
void describe(const ros::Command &command, crossguard::Body &body);

// Sets position and heading of the body to those of the pose. Throws `Refusal`.
void place(const ros::PoseStamped &pose, const Site &site, crossguard::Body &body);

#endif // CROSSGUARD_DDS_HEARING_HPP
