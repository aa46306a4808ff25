#!/usr/bin/python3
"""A thousand bad requests and messages, made by hand and at random (seed 1). Each request is answered with a code and a
sentence, and the node identifies correctly afterwards."""

import io
import pathlib
import random
import struct
import sys
import unittest

import actionlib
import rospy
import rostest
from std_srvs.srv import Trigger
from uncertainty_identification.msg import (
    Covariate,
    Experiment,
    ExplainExperimentsAction,
    ExplainExperimentsActionGoal,
    ExplainExperimentsGoal,
    IdentifyBagsAction,
    IdentifyBagsActionGoal,
    IdentifyBagsGoal,
)
from uncertainty_identification.srv import (Configure, GetResult, Identify, IdentifyRequest, ListExperiments, Load,
                                            RejectExperiment, SampleModels, Save, WriteReport)

sys.path.append(str(pathlib.Path(__file__).parent.parent / "support"))
import client

NODE = "/identification"
POLE = 0.8
CONFIGURATION = """{nominal_model: {structure: arx, nb: 1, na: 1, delay: 1}, error_model: {taps: 0},
  limits: {max_samples: 10000, max_experiments: 100}}"""  # as in hostile.test
NUMBERS = [float("nan"), float("inf"), float("-inf"), 0.0, -1.0, 1e308, -1e308, 5e-324, 1e300]
LENGTHS = [0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 0x10000000, 1000000, 1]
NAMES = ["", ".", "..", "/", "../../etc/passwd", "/etc/passwd", "a/../../b.bag", "/dev/zero", "x" * 100000, "a\0.bag",
         "%s%n%s", "~", "$(reboot)", "\n", "\u202e", "con.bag", "..bag", ".bag", "-rf.bag", "/proc/self/mem"]
TEXTS = ["", "[" * 50000, "{a: " * 10000, "- " * 30000, "x" * 100000, "&a [*a]", "{a: &x [1], b: *x}", "\0\1\2", "{",
         "nominal_model: {nb: 1e99}", "{nominal_model: {nb: -1}}", "{limits: {max_samples: 2147483647}}",
         "{bag_directory: /}", "{store_directory: /tmp}", "!!python/object:os.system ls", "{estimation: {threads: 999999}}",
         "{error_model: {taps: 11, components: 10}, sample_time: 1.0e-300}", "{initial: {theta: [.nan, .inf]}}"]


def raw(kind, data):
    """A message that claims to be of a kind and holds any bytes."""

    class Raw(kind):
        def serialize(self, buff):
            buff.write(data)

    return Raw


def broken(message, draw):
    """The bytes of a message with a wrong length, a bit turned over, cut short, or with something behind."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    data = bytearray(buffer.getvalue())
    way = draw.randrange(4)
    if way == 0 and len(data) >= 4:
        at = draw.randrange(len(data) - 3)
        data[at:at + 4] = struct.pack("<I", draw.choice(LENGTHS))
    elif way == 1 and data:
        data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)
    elif way == 2:
        del data[draw.randrange(len(data) + 1):]
    else:
        data += bytes(draw.randrange(256) for _ in range(draw.randrange(100)))
    return bytes(data)


def bad_experiment(draw):
    """An experiment in which something does not fit."""
    experiment = client.first_order_experiment(draw.choice(NAMES), POLE, draw.randrange(99), draw.randrange(1 << 31), 50)
    way = draw.randrange(7)
    if way == 0:
        experiment.u[draw.randrange(50)] = draw.choice(NUMBERS)
    elif way == 1:
        experiment.y = [draw.choice(NUMBERS) for _ in range(draw.choice((0, 1, 49, 50, 51)))]
    elif way == 2:
        experiment.sample_time = draw.choice(NUMBERS)
    elif way == 3:
        experiment.valid = bytes(draw.randrange(200))
    elif way == 4:
        experiment.covariates = [Covariate(draw.choice(NAMES), draw.randrange(256), [draw.choice(NUMBERS)])] * 3
    elif way == 5:
        experiment.u = experiment.y = [1.0] * draw.choice((0, 1, 50, 20000))
    else:
        experiment.stamp_offset = [draw.choice(NUMBERS)] * draw.choice((1, 50))
    return experiment


class Hostile(unittest.TestCase):
    def setUp(self):
        self.draw = random.Random(1)
        self.assertTrue(client.call(f"{NODE}/reset", Trigger).success)

    def expect_sentence(self, service, kind, /, **request):
        answer = client.call(f"{NODE}/{service}", kind, **request)
        self.assertTrue(answer.message, f"{service} {str(request)[:200]}")
        return answer

    def expect_refusal(self, service, kind, /, **request):
        answer = self.expect_sentence(service, kind, **request)
        self.assertNotEqual(answer.code, 0, f"{service} {str(request)[:200]}")

    def expect_correct_identification(self):
        self.assertTrue(client.call(f"{NODE}/reset", Trigger).success)
        experiments = [client.first_order_experiment(f"good{k}", POLE, k, 100 + 10 * k) for k in range(4)]
        answer = client.call(f"{NODE}/identify", Identify, experiments=experiments, bags=[], configuration="")
        self.assertEqual(answer.code, 0, answer.message)
        self.assertAlmostEqual(answer.result.nominal_model.a[0], -POLE, delta=0.05)
        publisher = rospy.Publisher(f"{NODE}/experiment", Experiment, queue_size=10)
        self.assertTrue(client.wait_for(lambda: publisher.get_num_connections() > 0))
        for experiment in experiments:
            publisher.publish(experiment)
        last = lambda: client.call(f"{NODE}/get_result", GetResult)
        self.assertTrue(client.wait_for(lambda: last().result.experiment_count == 4), last().message)
        self.assertAlmostEqual(last().result.nominal_model.a[0], -POLE, delta=0.05)

    def test_names_and_texts(self):
        for name in NAMES:
            self.expect_refusal("identify", Identify, experiments=[], bags=[name], configuration="")
            self.expect_refusal("reject_experiment", RejectExperiment, id=name, reason=name)
            self.expect_refusal("save", Save, name=name)
            self.expect_refusal("load", Load, name=name)
            self.expect_refusal("write_report", WriteReport, name=name)
        for text in TEXTS:
            self.expect_sentence("configure", Configure, configuration=text)  # some are odd, but valid
            self.expect_refusal("identify", Identify, experiments=[], bags=[], configuration=text)
        answer = self.expect_sentence("configure", Configure, configuration=CONFIGURATION)
        self.assertEqual(answer.code, 0, answer.message)
        for count in (0, 10001, 0xFFFFFFFF):
            self.expect_refusal("sample_models", SampleModels, count=count, seed=0, uncertainty=255)
        for service in ("start_experiment", "finish_experiment", "discard_experiment"):
            answer = client.call(f"{NODE}/{service}", Trigger)
            self.assertFalse(answer.success)
            self.assertTrue(answer.message)
        self.expect_correct_identification()

    def expect_goals_refused(self, action, kind, goal):
        # not SimpleActionClient: it waits forever for a goal that is refused before its send_goal() has returned
        server = actionlib.ActionClient(f"{NODE}/{action}", kind)
        self.assertTrue(server.wait_for_server(rospy.Duration(240)))
        for one in [goal(bags=[name]) for name in NAMES] + [goal([], text) for text in TEXTS]:
            sent = server.send_goal(one)
            self.assertTrue(client.wait_for(lambda: sent.get_comm_state() == actionlib.CommState.DONE), str(one)[:200])
            self.assertTrue(sent.get_result().message)
            self.assertNotEqual(sent.get_result().code, 0)

    def test_goals(self):
        self.expect_goals_refused("identify_bags", IdentifyBagsAction, IdentifyBagsGoal)
        self.expect_goals_refused("explain_experiments", ExplainExperimentsAction, ExplainExperimentsGoal)
        self.expect_correct_identification()

    def test_broken_goals(self):
        for action, kind, goal in (
            ("identify_bags", IdentifyBagsActionGoal, IdentifyBagsGoal),
            ("explain_experiments", ExplainExperimentsActionGoal, ExplainExperimentsGoal),
        ):
            publisher = rospy.Publisher(f"{NODE}/{action}/goal", kind, queue_size=1000)
            self.assertTrue(client.wait_for(lambda: publisher.get_num_connections() > 0))
            good = kind(goal=goal(["a.bag"], "{}"))
            for _ in range(100):
                publisher.publish(raw(kind, broken(good, self.draw))())
        self.expect_correct_identification()

    def test_experiments_in_requests(self):
        for _ in range(150):
            experiments = [bad_experiment(self.draw) for _ in range(self.draw.randrange(1, 4))]
            self.expect_sentence("identify", Identify, experiments=experiments, bags=[], configuration="")
        many = [client.first_order_experiment(str(k), POLE, k, k, 25) for k in range(101)]
        self.expect_refusal("identify", Identify, experiments=many, bags=[], configuration="")
        self.expect_correct_identification()

    def test_broken_requests(self):
        request = IdentifyRequest([client.first_order_experiment("a", POLE, 1, 1, 50)], ["a.bag"], "{}")
        rospy.wait_for_service(f"{NODE}/identify", timeout=240)
        for _ in range(250):
            class Broken(Identify):
                _request_class = raw(IdentifyRequest, broken(request, self.draw))

            answer = rospy.ServiceProxy(f"{NODE}/identify", Broken)(Broken._request_class())
            self.assertTrue(answer.message)
        self.expect_correct_identification()

    def test_messages(self):
        good = client.first_order_experiment("a", POLE, 1, 1, 50)
        publisher = rospy.Publisher(f"{NODE}/experiment", Experiment, queue_size=1000)
        self.assertTrue(client.wait_for(lambda: publisher.get_num_connections() > 0))
        for _ in range(250):
            publisher.publish(bad_experiment(self.draw))
            publisher.publish(raw(Experiment, broken(good, self.draw))())
        self.assertTrue(client.call(f"{NODE}/list_experiments", ListExperiments) is not None)
        self.expect_correct_identification()


if __name__ == "__main__":
    rospy.init_node("hostile_test")
    rostest.rosrun("uncertainty_identification", "hostile", Hostile)
