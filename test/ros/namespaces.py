#!/usr/bin/python3
"""Two nodes in two namespaces on one master, with different configurations, do not disturb each other."""

import pathlib
import sys
import unittest

import rospy
import rostest
from std_srvs.srv import Trigger
from uncertainty_identification.msg import Experiment
from uncertainty_identification.srv import GetResult, GetResultResponse, ListExperiments

sys.path.append(str(pathlib.Path(__file__).parent.parent / "support"))
import client

POLES = {"left": 0.5, "right": 0.9}
STRUCTURES = {"left": "arx", "right": "output_error"}
COUNT = 4


class Namespaces(unittest.TestCase):
    def ids(self, side):
        listed = client.call(f"/{side}/identification/list_experiments", ListExperiments).experiments
        return [experiment.id for experiment in listed]

    def result(self, side):
        return client.call(f"/{side}/identification/get_result", GetResult)

    def send(self, side):
        publisher = rospy.Publisher(f"/{side}/identification/experiment", Experiment, queue_size=10)
        self.assertTrue(client.wait_for(lambda: publisher.get_num_connections() > 0))
        for k in range(COUNT):
            publisher.publish(client.first_order_experiment(f"{side}{k}", POLES[side], k, 100 + 10 * k))
        self.assertTrue(client.wait_for(lambda: len(self.ids(side)) == COUNT))

    def test_each_node_holds_its_own(self):
        for side in POLES:
            self.send(side)
        for side, pole in POLES.items():
            self.assertEqual(self.ids(side), [f"{side}{k}" for k in range(COUNT)])
            self.assertTrue(client.wait_for(lambda: self.result(side).result.experiment_count == COUNT))
            model = self.result(side).result.nominal_model
            self.assertEqual(model.structure, STRUCTURES[side])
            self.assertAlmostEqual(model.a[0], -pole, delta=0.05)  # 800 samples, noise of 1 %
        self.assertTrue(client.call("/left/identification/reset", Trigger).success)
        self.assertEqual(self.result("left").code, GetResultResponse.NONE_YET)
        self.assertEqual(self.ids("left"), [])
        self.assertEqual(len(self.ids("right")), COUNT)
        self.assertEqual(self.result("right").code, GetResultResponse.OK)


if __name__ == "__main__":
    rospy.init_node("namespaces_test")
    rostest.rosrun("uncertainty_identification", "namespaces", Namespaces)
