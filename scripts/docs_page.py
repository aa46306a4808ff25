"""A scratch folder in which the blocks of one page are run, for scripts/check_docs, which says what the comments mean."""
import os
import re
import signal
import socket
import subprocess
import time

from docs_blocks import PATH, ROOT, Failure, commands

LONGEST = 120  # [s] that a command may take
NUMBER = r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
STATE = """[ ! -e {0} ] || . {0}
trap 'code=$?; {{ export -p; printf "cd %q\\n" "$PWD"; }} >{0}; exit $code' EXIT
"""  # what a command has exported, and where it has gone, holds for the next


def is_printed(wanted, line):
    """Whether two lines have the same words, and numbers that differ by 2 % at most."""
    if re.sub(NUMBER, "#", wanted).split() != re.sub(NUMBER, "#", line).split():
        return False
    pairs = zip(re.findall(NUMBER, wanted), re.findall(NUMBER, line))
    return all(abs(float(one) - float(other)) <= 0.02 * abs(float(one)) for one, other in pairs)


class Page:
    """A scratch folder and an environment in which the blocks of one page are run one after the other."""

    def __init__(self, path, folder):
        self.path, self.folder, self.output, self.running, self.skipped, self.done = path, folder, "", [], [], []
        os.makedirs(folder + "/scripts")
        for entry in set(os.listdir(ROOT)) - {".git", "scripts"}:
            os.symlink(os.path.join(ROOT, entry), os.path.join(folder, entry))
        for script in os.listdir(ROOT + "/scripts"):  # no links: scripts find the sources by their own names
            with open(os.open(f"{folder}/scripts/{script}", os.O_CREAT | os.O_WRONLY, 0o755), "w") as wrapper:
                wrapper.write(f'#!/bin/sh\nexec {ROOT}/scripts/{script} "$@"\n')
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            master = f"http://127.0.0.1:{free.getsockname()[1]}"
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
        self.environment.update(PATH=PATH, ROS_MASTER_URI=master, ROS_IP="127.0.0.1", ROS_HOME=folder + ".ros")

    def fail(self, line, command, what, output):
        raise Failure(f"{self.path}:{line}: {command}\n{what}\n{output}")

    def start(self, command):
        log = open(f"{self.folder}.{len(self.done)}.log", "w+")
        script = STATE.format(self.folder + ".state") + command
        return log, subprocess.Popen(["bash", "-c", script], cwd=self.folder, env=self.environment, start_new_session=True,
                                     stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)

    def execute(self, command):
        """The exit status and the output of a command."""
        log, process = self.start(command)
        try:
            status = process.wait(LONGEST)
        except subprocess.TimeoutExpired:
            status = f"none within {LONGEST} s"
        finally:
            if process.poll() is None:  # also where the user ends this program
                os.killpg(process.pid, signal.SIGTERM)
                process.wait()
        with open(log.name) as written:
            return status, written.read()

    def run(self, line, command):
        status, self.output = self.execute(command)
        if status != 0:
            self.fail(line, command, f"exit status {status}", self.output)
        self.done.append("commands")

    def keep(self, line, command, test):
        """Starts a command that runs on, and waits until `test` succeeds."""
        log, process = self.start(command)
        self.done.append("commands")
        until = time.monotonic() + LONGEST
        self.running.insert(0, (line, command, log, process))
        while self.execute(test)[0] != 0:
            if process.poll() is not None or time.monotonic() > until:
                self.fail(line, command, f"has ended, or '{test}' does not succeed", open(log.name).read())
            time.sleep(0.5)

    def compare(self, line, text):
        """Whether the last command has printed these lines."""
        left = iter(self.output.splitlines())
        for number, wanted in enumerate(text.splitlines(), line):
            if wanted and not any(is_printed(wanted, found) for found in left):
                self.fail(number, wanted, "is not what the last command prints:", self.output)
        self.done.append("outputs")

    def look_up(self, line, text):
        """Whether the programs of a synopsis know its options."""
        for number, usage in enumerate(text.splitlines(), line):
            status, known = self.execute(f"env {usage.removeprefix('env ').split()[0]} --help")
            for option in re.findall(r"--\w[\w-]*", usage):
                if status != 0 or not re.search(option + r"\b", known):
                    self.fail(number, usage, f"{option} is not in --help:", known)
        self.done.append("synopses")

    def accept(self, line, text):
        """Whether identify takes a configuration: it goes on to the data, which do not exist."""
        with open(self.folder + "/accepted.yaml", "w") as file:
            file.write(text)
        answer = self.execute("identify --config accepted.yaml --output none.json no_such_data.csv")[1]
        if "'no_such_data.csv' does not exist" not in answer:
            self.fail(line, text, "is not accepted:", answer)
        self.done.append("configurations")

    def check(self, line, mark, argument, kind, text):
        if mark == "not run":
            self.skipped.append(f"{self.path}:{line}: {argument}")
        elif mark in ("synopsis", "printed"):
            (self.look_up if mark == "synopsis" else self.compare)(line, text)
        elif kind == "commands":
            for number, command in commands(line, text):
                self.keep(number, command, argument) if mark == "keeps running" else self.run(number, command)
        elif kind == "configuration":
            self.accept(line, text)
        if mark == "file":
            with open(os.path.join(self.folder, argument), "w") as file:
                file.write(text + "\n")

    def stop(self):
        """Ends what keeps running; it must not have ended by itself."""
        ended = [one for one in self.running if one[-1].poll() is not None]
        for _, _, _, process in self.running:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGINT)
                process.wait(60)
        for line, command, log, _ in ended:
            self.fail(line, command, "has ended by itself", open(log.name).read())
