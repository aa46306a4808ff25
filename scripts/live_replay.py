"""A node into which a bag is replayed, with its live page: for make_screenshots and check_live_page."""
import contextlib
import os
import signal
import socket
import subprocess
import sys

sys.dont_write_bytecode = True
import report_figures as reports  # noqa: E402

RATE = 3  # times faster than recorded
TOPICS = "/actuator/command /sensor/measurement /experiment/active"


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


@contextlib.contextmanager
def live_page(folder):
    """The address of the page of a node that records the runs of a motor, 24 of 4 s; everything else is chosen from them."""
    configuration = reports.written(os.path.join(folder, "motor.yaml"), "experiment: {mode: topic, topic: experiment/active}\n")
    bag = os.path.join(folder, "motor.bag")
    reports.run("simulate", "--config", os.path.join(reports.ROOT, "config/motor_truth.yaml"), "--output", bag)
    port = free_port()
    arguments = ["-p", str(free_port()), os.path.join(reports.ROOT, "launch/replay.launch"), "bag:=" + bag,
                 "config:=" + configuration, "topics:=" + TOPICS,
                 "rate:=%d" % RATE, "live_page:=%d" % port]
    log = open(os.path.join(folder, "replay.log"), "w", encoding="utf-8")
    setup = os.path.join(reports.ROOT, "build/devel/setup.bash")
    launched = subprocess.Popen(["bash", "-c", 'source "$0" && exec roslaunch "$@"', setup, *arguments], stdout=log,
                                stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, "ROS_HOME": folder, "ROS_IP": "127.0.0.1"})
    try:
        yield "http://127.0.0.1:%d/" % port
    finally:
        os.killpg(launched.pid, signal.SIGINT)
        launched.wait(60)
        log.close()


def open_page(browser, address, seconds=120):
    """Opens the page, as soon as the node serves it."""
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.support.ui import WebDriverWait

    def opened(_):
        try:
            browser.get(address)
        except WebDriverException:
            return False
        return browser.title == "Identification, live"

    WebDriverWait(browser, seconds).until(opened)


def wait_for(browser, condition, seconds=120):
    """Waits until a condition in JavaScript holds."""
    from selenium.webdriver.support.ui import WebDriverWait
    WebDriverWait(browser, seconds, 0.05).until(lambda _: browser.execute_script("return Boolean(%s)" % condition))
