#!/usr/bin/python3
"""Every shipped launch file, started as its users do: the nodes come up with the configuration that belongs to it."""

import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.request

import rosbag
import rosnode
import rospy
import rostest
from geometry_msgs.msg import Twist, TwistWithCovarianceStamped
from uncertainty_identification.msg import IdentificationStatus
from uncertainty_identification.srv import ListExperiments

sys.path.append(str(pathlib.Path(__file__).parent.parent / "support"))
import client

LAUNCH = pathlib.Path(__file__).resolve().parent.parent.parent / "launch"
NODES = {
    "identification.launch": "/identification",
    "fault_detection.launch": "/fault_detection",
    "robust_margin.launch": "/robust_margin",
    "replay.launch": "/identification",
}


def write_drive(path):
    """A robot that follows its commands, 25 s at 20 Hz, without headers on the command's topic."""
    with rosbag.Bag(path, "w") as bag:
        speed = 0.0
        for k in range(500):
            command, odometry = Twist(), TwistWithCovarianceStamped()
            command.linear.x = 0.5 if (k // 20) % 3 else -0.5
            speed += 0.2 * (command.linear.x - speed)
            stamp = rospy.Time.from_sec(1000 + 0.05 * k)
            odometry.header.stamp = stamp
            odometry.twist.twist.linear.x = speed
            bag.write("/cmd_vel", command, stamp)
            bag.write("/odom", odometry, stamp)


def serves_pages():
    """Whether the library that was built can serve the live page (cmake/live_page.cmake)."""
    library = pathlib.Path(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib/libuncertainty_identification_io.so")
    return "cpp-httplib" in subprocess.run(["ldd", str(library)], stdout=subprocess.PIPE, check=True).stdout.decode()


class LaunchFiles(unittest.TestCase):
    def start(self, name, *arguments):
        launched = subprocess.Popen(["roslaunch", str(LAUNCH / name), *arguments])
        self.addCleanup(self.stop, launched, NODES[name])
        self.assertTrue(client.wait_for(lambda: NODES[name] in rosnode.get_node_names()), name)

    @staticmethod
    def stop(launched, node):
        launched.send_signal(signal.SIGINT)
        launched.wait(240)
        client.wait_for(lambda: node not in rosnode.get_node_names())

    def test_none_is_forgotten(self):
        self.assertEqual({path.name for path in LAUNCH.glob("*.launch")}, set(NODES))

    def test_identification(self):
        self.start("identification.launch")
        self.assertEqual(client.call("/identification/list_experiments", ListExperiments).experiments, [])
        self.assertEqual(rospy.get_param("/identification/experiment/mode"), "topic")

    @unittest.skipUnless(serves_pages(), "this package was built without cpp-httplib")
    def test_live_page(self):
        with socket.socket() as found:
            found.bind(("127.0.0.1", 0))
            port = found.getsockname()[1]
        self.start("identification.launch", f"live_page:={port}", "respawn:=false")
        self.assertEqual(rospy.get_param("/identification/live_page/port"), port)
        rospy.wait_for_message("/identification/status", IdentificationStatus, timeout=240)
        page = urllib.request.urlopen(f"http://127.0.0.1:{port}/").read().decode()
        self.assertIn("showLive(", page)

    def test_fault_detection(self):
        self.start("fault_detection.launch")
        self.assertTrue(client.wait_for(lambda: published("/fault_detection/fault")))

    def test_robust_margin(self):
        self.start("robust_margin.launch")
        self.assertTrue(client.wait_for(lambda: published("/robust_margin/margin")))

    def test_replay(self):
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        with tempfile.TemporaryDirectory() as folder:
            bag = folder + "/drive.bag"
            write_drive(bag)
            self.start("replay.launch", f"bag:={bag}", "rate:=5")
            listed = lambda: client.call("/identification/list_experiments", ListExperiments).experiments
            self.assertTrue(client.wait_for(lambda: len(listed()) >= 2))


def published(topic):
    return topic in [name for name, _ in rospy.get_published_topics()]


if __name__ == "__main__":
    rospy.init_node("launch_files_test")
    rostest.rosrun("uncertainty_identification", "launch_files", LaunchFiles)
