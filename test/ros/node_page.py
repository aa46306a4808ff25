#!/usr/bin/python3
"""docs/node.md says what the running node, started with all of config/reference.yaml, advertises: no more, no less."""

import pathlib
import unittest

import rosgraph
import rospy
import rosservice
import rostest
import yaml
from uncertainty_identification.msg import IdentificationStatus

PROJECT = pathlib.Path(__file__).resolve().parent.parent.parent
NODE = "/identification"
EVERY_NODE = {"/rosout", "/clock"}  # topics, and ...
LOGGING = {NODE + "/get_loggers", NODE + "/set_logger_level"}  # ... services that roscpp gives each
ACTION_TOPICS = ("goal", "cancel", "status", "feedback", "result")


def table(section):
    """The rows of the first table below a heading, without its own head; cells without backticks."""
    lines = (PROJECT / "docs/node.md").read_text().split(f"\n## {section}\n")[1].splitlines()
    rows = []
    for line in lines[next(i for i, line in enumerate(lines) if line.startswith("|")) + 2:]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip().strip("`") for cell in line.strip("|").split("|")])
    return rows


def full(name):
    return NODE + "/" + name[1:] if name.startswith("~") else "/" + name.lstrip("/")


def leaves(tree, prefix=""):
    """Keys, joined by dots, with their values; an empty group counts as a value."""
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, prefix + key + ".")
        else:
            yield prefix + key, value


class NodePage(unittest.TestCase):
    def setUp(self):
        self.master = rosgraph.Master("node_page_test")
        rospy.wait_for_message(full("~status"), IdentificationStatus, timeout=240)  # told once all is advertised
        self.types = dict(self.master.getTopicTypes())

    def of_node(self, kind):
        """What the node publishes (0), subscribes to (1) or serves (2)."""
        return {name for name, nodes in self.master.getSystemState()[kind] if NODE in nodes}

    def action_topics(self):
        return {full(name) + "/" + part for name, _, _ in table("Actions") for part in ACTION_TOPICS}

    def test_topics(self):
        rows = table("Topics")
        for kind, direction in ((0, "published"), (1, "subscribed")):
            documented = {full(name) for name, how, _, _ in rows if how.startswith(direction)}
            self.assertEqual(documented, self.of_node(kind) - EVERY_NODE - self.action_topics(), direction)
        for name, how, kind, _ in rows:
            if how.startswith("published"):
                self.assertEqual(kind, self.types[full(name)], name)

    def test_services(self):
        rows = table("Services")
        self.assertEqual({full(name) for name, _, _ in rows}, self.of_node(2) - LOGGING)
        for name, kind, _ in rows:
            self.assertEqual(kind, rosservice.get_service_type(full(name)), name)

    def test_actions(self):
        rows = table("Actions")
        goals = {name for name in self.of_node(1) if name.endswith("/goal")}
        self.assertEqual({full(name) + "/goal" for name, _, _ in rows}, goals)
        for name, kind, _ in rows:
            self.assertEqual(kind + "ActionResult", self.types[full(name) + "/result"], name)

    def test_parameters(self):
        reference = dict(leaves(yaml.safe_load((PROJECT / "config/reference.yaml").read_text())))
        documented = {key: yaml.safe_load(default) for key, default, _ in table("Parameters")}
        self.assertEqual(documented, reference)
        loaded = dict(leaves(rospy.get_param(NODE)))
        self.assertEqual(set(loaded), {key for key, value in reference.items() if value != {}})
        for key, _, meaning in table("Parameters"):
            self.assertTrue(meaning, key)


if __name__ == "__main__":
    rospy.init_node("node_page_test")
    rostest.rosrun("uncertainty_identification", "node_page", NodePage)
