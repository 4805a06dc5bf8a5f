"""The worker's loop: one command, one answer."""
import faulthandler
import os
import signal
import sys
import time
import traceback

import zmq

from . import messages

BEAT = 0.5  # [s] between signs of life

os.environ["OMP_NUM_THREADS"] = "1"  # with more, the order of sums and so the bits would change


class Line:
    """To the program."""

    def __init__(self, endpoint):
        self._socket = zmq.Context().socket(zmq.PAIR)
        self._socket.setsockopt(zmq.LINGER, 1000)
        self._socket.connect(endpoint)
        self._last = time.monotonic()

    def say(self, kind, body=None):
        self._socket.send(messages.pack(kind, body))
        self._last = time.monotonic()

    def listen(self):
        return messages.unpack(self._socket.recv())

    def beat(self):
        if time.monotonic() - self._last > BEAT:
            self.say(messages.HEARTBEAT)


def open_session(body, beat):
    try:
        from .session import Session  # loads YADE: about 2 s
    except ImportError as error:
        raise RuntimeError(f"YADE cannot be loaded ({error}): install the Debian packages libyade, python3-future, python3-mpmath "
                           "and python3-ipython, or start couloir by its front door ./couloir, which does") from error
    return Session(*messages.start(body), beat)


def serve(endpoint):
    faulthandler.enable()  # where a crash of the engine happened is then in the log
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the program's business
    line = Line(endpoint)
    line.say(messages.HELLO, [os.getpid()])
    session = None
    while True:
        kind, body = line.listen()
        if kind == messages.STOP:
            break
        try:
            if kind == messages.START:
                session = open_session(body, line.beat)
                line.say(messages.STARTED, [session.name])
            elif session is None:
                raise RuntimeError("a command came before the start")
            elif kind == messages.ADVANCE:
                line.say(messages.ADVANCED, session.advance(messages.request(body)))
            elif kind == messages.CHECKPOINT:
                session.checkpoint(body[0])
                line.say(messages.DONE)
            else:
                raise RuntimeError(f"the worker got a message of kind {kind}")
        except Exception as error:
            traceback.print_exc()
            line.say(messages.FAILED, [str(error) or repr(error), getattr(error, "runaway", False)])
            session = None
    sys.stdout.flush()
    os._exit(0)  # YADE's own clean-up at exit is slow
