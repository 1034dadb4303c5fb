# SPDX-License-Identifier: MIT
"""board - ladderd and ladder-modbus in a folder of their own, for tests and benches."""
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time

BUILD = os.path.abspath(os.environ.get('BUILD', 'build'))
MODBUS = BUILD + '/ladder-modbus'


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return probe.getsockname()[1]


def until(what, seconds=60):
    """Waits until what() is true. Returns its last value. Only a hang takes so long."""
    end = time.monotonic() + seconds
    while True:
        value = what()
        if value or time.monotonic() > end:
            return value
        time.sleep(0.005)


def crc(data):
    """The check of RTU, from the specification."""
    value = 0xffff
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ 0xa001 if value & 1 else value >> 1
    return bytes([value & 255, value >> 8])


class Board:
    """ladderd and ladder-modbus in a folder of their own."""

    def __init__(self, program, board, *options):
        self.folder = tempfile.mkdtemp()
        self.write('program.rung', program)
        self.write('board.io', board)
        self.write('groups', ''.join(f'ladder-{role}:x:{os.getgid()}:\n' for role in ('eng', 'io')))
        self.ladderd = self.modbus = None
        self.options = options
        self.start_ladderd()
        self.start_modbus()

    def write(self, name, text):
        with open(f'{self.folder}/{name}', 'w', encoding='utf-8') as out:
            out.write(text)

    def read(self, name):
        with open(f'{self.folder}/{name}', encoding='utf-8', errors='replace') as file:
            return file.read()

    def spawn(self, name, *words):
        with open(f'{self.folder}/{name}.out', 'a', encoding='utf-8') as out:
            return subprocess.Popen(words, cwd=self.folder, stdout=out, stderr=out, stdin=subprocess.DEVNULL)

    def start_ladderd(self):
        self.ladderd = self.spawn('ladderd', BUILD + '/ladderd', 'program.rung', '--io', 'board.io', '--link', 'link', '--groups', 'groups',
                                  '--period', '5ms', *self.options)

    def start_modbus(self):
        self.modbus = self.spawn('modbus', MODBUS, '--link', 'link')

    def status(self):
        """What SIGUSR1 prints."""
        before = len(self.read('modbus.out'))
        self.modbus.send_signal(signal.SIGUSR1)
        until(lambda: self.read('modbus.out')[before:].endswith('\n'))
        return self.read('modbus.out')[before:]

    def command(self, *words):
        done = subprocess.run([BUILD + '/ladder', 'board', 'unix:link', *words], cwd=self.folder, text=True,
                              capture_output=True, timeout=60, check=False)
        return done.stdout + done.stderr

    def __enter__(self):
        return self

    def __exit__(self, kind, *_error):
        for process in (self.modbus, self.ladderd):
            process.send_signal(signal.SIGTERM)
            process.wait(60)
        if kind:
            for name in filter(lambda it: os.path.exists(f'{self.folder}/{it}'), ('ladderd.out', 'modbus.out')):
                print(f'# {name}:\n# ' + self.read(name)[-1500:].replace('\n', '\n# '))
        shutil.rmtree(self.folder)
