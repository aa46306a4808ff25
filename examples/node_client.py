#!/usr/bin/env python3
"""Asks a running identification node, by its services and its action.

    node_client.py status              what it is doing
    node_client.py list                the experiments it keeps and rejected
    node_client.py result              the model of the last result
    node_client.py reject ID [REASON]  leaves an experiment out
    node_client.py start|finish|discard|reset
    node_client.py bags NAME...        identifies from bags below the node's bag_directory; Ctrl-C cancels

Exit status: 0 done; 1 the node answered why not. The node is /identification unless _node:=/name says otherwise.
"""

import sys
import time

import actionlib
import rospy
from std_srvs.srv import Trigger
from uncertainty_identification.msg import (IdentificationStatus, IdentifyBagsAction, IdentifyBagsGoal)
from uncertainty_identification.srv import GetResult, ListExperiments, RejectExperiment

TRIGGERS = {"start": "start_experiment", "finish": "finish_experiment", "discard": "discard_experiment", "reset": "reset"}
TERMINATIONS = ("NOT_RUN", "CONVERGED", "ITERATION_LIMIT", "STALLED", "CANCELLED", "TIME_LIMIT")


class Node:
    """The services and the action of one identification node."""

    def __init__(self, name):
        self.name = name

    def call(self, service, kind, *request):
        """The answer of a service."""
        name = f"{self.name}/{service}"
        rospy.wait_for_service(name, timeout=30)
        return rospy.ServiceProxy(name, kind)(*request)

    def status(self):
        """The latched status."""
        return rospy.wait_for_message(f"{self.name}/status", IdentificationStatus, timeout=30)

    def identify_bags(self, names, feedback):
        """The result of the action, or None where there is no such node."""
        # not SimpleActionClient: it waits forever for a goal that is refused before its send_goal() has returned
        client = actionlib.ActionClient(f"{self.name}/identify_bags", IdentifyBagsAction)
        if not client.wait_for_server(rospy.Duration(30)):
            return None
        goal = client.send_goal(IdentifyBagsGoal(bags=names), feedback_cb=lambda _, now: feedback(now))
        rospy.on_shutdown(goal.cancel)
        while goal.get_comm_state() != actionlib.CommState.DONE and not rospy.is_shutdown():
            time.sleep(0.05)
        return goal.get_result()


def print_model(result):
    """Parameters with their standard errors."""
    model = result.nominal_model
    print(f"{model.structure}, {result.experiment_count} experiments: {result.message}")
    for parameter in model.parameters:
        print(f"  {parameter.name} = {parameter.value:.6g} +- {parameter.standard_error:.2g} {parameter.unit}")


def report(code, message):
    """Ends the program where the code is not OK."""
    if code != 0:
        sys.exit(f"the node answered with code {code}: {message}")


def name_of(number, names):
    """The name of the constant of IdentificationStatus with this value."""
    return next((name for name in names if getattr(IdentificationStatus, name) == number), str(number))


def show_status(node):
    status = node.status()
    print("state:", name_of(status.state, ("IDLE", "COLLECTING", "IDENTIFYING", "ERROR")))
    print("last identification:", name_of(status.termination, TERMINATIONS), f"in {status.seconds:.3g} s: {status.message}")
    for what, since in zip(status.running, status.running_since):
        print(f"running: {what} for {max(0.0, (rospy.Time.now() - since).to_sec()):.1f} s")
    print(f"waiting: {status.waiting_requests} requests, {status.queue} experiments")
    print(f"experiments kept: {status.stored_count}, the last is '{status.last_stored_id}'; last result: {status.sequence}")
    for problem in [status.store_problem] * bool(status.store_problem) + list(status.problems):
        print("problem:", problem)


def show_result(node):
    answer = node.call("get_result", GetResult)
    report(answer.code, answer.message)
    print_model(answer.result)


def show_list(node):
    for experiment in node.call("list_experiments", ListExperiments).experiments:
        print(f"{experiment.id}: {experiment.rejected or f'{experiment.samples} samples'}")


def reject(node, identifier, reason=""):
    answer = node.call("reject_experiment", RejectExperiment, identifier, reason)
    report(answer.code, answer.message)
    print(answer.message)


def trigger(node, service):
    answer = node.call(service, Trigger)
    report(0 if answer.success else 1, answer.message)
    print(answer.message)


def identify_bags(node, names):
    result = node.identify_bags(names, lambda now: print(f"{100 * now.fraction:3.0f} % {now.phase}"))
    if result is None:
        sys.exit("the node has no action identify_bags")
    report(result.code, result.message)
    print_model(result.result)


def main():
    arguments = rospy.myargv(sys.argv)[1:]
    rospy.init_node("node_client", anonymous=True)
    node = Node(rospy.get_param("~node", "/identification"))
    if arguments == ["status"]:
        show_status(node)
    elif arguments == ["list"]:
        show_list(node)
    elif arguments == ["result"]:
        show_result(node)
    elif arguments[:1] == ["reject"] and len(arguments) in (2, 3):
        reject(node, *arguments[1:])
    elif len(arguments) == 1 and arguments[0] in TRIGGERS:
        trigger(node, TRIGGERS[arguments[0]])
    elif arguments[:1] == ["bags"] and len(arguments) > 1:
        identify_bags(node, arguments[1:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
