"""What the Python tests of the node share: waiting, calling, and experiments of a system that is known."""

import random
import time

import rospy
from uncertainty_identification.msg import Experiment


def wait_for(condition, limit=240):
    """Waits until the condition holds; false when it does not within the limit, which is generous."""
    end = time.monotonic() + limit
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def call(name, service, /, **request):
    """The answer of a service, once it is there."""
    rospy.wait_for_service(name, timeout=240)
    return rospy.ServiceProxy(name, service)(**request)


def first_order_experiment(name, pole, seed, start, samples=200):
    """y[k] = pole y[k-1] + (1 - pole) u[k-1] + noise, sampled at 100 Hz from `start` [s] on."""
    draw = random.Random(seed)
    y, outputs, inputs = 0.0, [], []
    for k in range(samples):
        inputs.append(draw.choice((-1.0, 1.0)) if k % 5 == 0 else inputs[-1])
        outputs.append(y + draw.gauss(0, 0.01))
        y = pole * y + (1 - pole) * inputs[-1]
    experiment = Experiment(id=name, sample_time=0.01, u=inputs, y=outputs)
    experiment.header.stamp = rospy.Time.from_sec(start)
    return experiment
