#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""ways_out - what outputs at a Modbus device and a word in memory do on each way out of RUN.

The device is the few lines below: it takes functions 5, 6, 15, 16 and answers 1 to 4.
"""
import os
import signal
import socket
import struct
import sys
import threading
import time
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from board import MODBUS, Board, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Speed AT %QW0   : INT;
  Share AT %QD4   : REAL;
  Valve AT %QX20.0 : BOOL;
  Kept  AT %QW10  : INT;
  Here  AT %QW12  : INT;
  Loop  AT %MX0.0 : BOOL;
END_VAR

PROGRAM Main ST
  Speed := 1234;
  Share := 2.5;
  Valve := TRUE;
  Kept := 55;
  Here := 9;
  WHILE Loop DO
    Speed := 1234;
  END_WHILE;
END_PROGRAM
'''
MAP = '''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:%d timeout=200ms
%%QW0   modbus bus=plant unit=1 holding-register=1 safe=77 refresh=50ms
%%QD4   modbus bus=plant unit=1 holding-register=2 as=REAL safe=0.25
%%QX20.0 modbus bus=plant unit=1 coil=2 safe=0
%%QW10  modbus bus=plant unit=1 holding-register=9 safe=hold
%%QW12  sim safe=3
'''
RUNS = {'word': 1234, 'real': 2.5, 'coil': 1, 'hold': 55}
SAFE = {'word': 77, 'real': 0.25, 'coil': 0, 'hold': 55}


class Device:
    """Registers and coils of unit 1; it counts what is written."""

    def __init__(self):
        self.registers, self.coils, self.writes = [0] * 20, [0] * 20, 0
        self.is_cut = False     # nothing arrives any more
        self.socket = socket.create_server(('127.0.0.1', 0))
        self.port = self.socket.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            try:
                stream = self.socket.accept()[0]
            except OSError:
                return
            threading.Thread(target=self.answer, args=(stream,), daemon=True).start()

    def answer(self, stream):
        with stream, stream.makefile('rwb') as file:
            while True:
                head = file.read(7)
                if len(head) < 7:
                    return
                body = file.read(struct.unpack('>H', head[4:6])[0] - 1)
                if self.is_cut:
                    continue
                answer = self.do(body)
                file.write(head[:4] + struct.pack('>HB', len(answer) + 1, head[6]) + answer)
                file.flush()

    def do(self, body):
        function, first, number = struct.unpack('>BHH', body[:5])
        self.writes += function in (5, 6, 15, 16)
        if function == 5:
            self.coils[first] = int(number == 0xff00)
        elif function == 6:
            self.registers[first] = number
        elif function == 15:
            for i in range(number):
                self.coils[first + i] = body[6 + i // 8] >> i % 8 & 1
        elif function == 16:
            self.registers[first:first + number] = struct.unpack('>%dH' % number, body[6:])
        else:
            return bytes([function | 0x80, 1])
        return body[:5]

    def has(self):
        return {'word': self.registers[1], 'real': struct.unpack('>f', struct.pack('>HH', *self.registers[2:4]))[0],
                'coil': self.coils[2], 'hold': self.registers[9]}


def is_quiet(device):
    """Nothing is written any more: longer than refresh= and a round of the bus."""
    before = device.writes
    time.sleep(0.4)
    return device.writes == before


def stop(it, _device):
    it.command('stop')


def fault(it, _device):
    it.command('set', 'Loop=1')


def end(it, _device):
    it.ladderd.send_signal(signal.SIGTERM)
    it.ladderd.wait(60)


def kill(it, _device):
    it.ladderd.kill()
    it.ladderd.wait(60)


def kill_gateway(it, _device):
    it.modbus.kill()
    it.modbus.wait(60)


def cut(_it, device):
    device.is_cut = True


# The way, what the device has then, and whether it is still refreshed.
WAYS = [('STOP', stop, SAFE, True), ('a FAULT', fault, SAFE, True), ('SIGTERM to ladderd', end, SAFE, False),
        ('SIGKILL to ladderd', kill, SAFE, False), ('SIGKILL to ladder-modbus', kill_gateway, RUNS, False), ('the network is cut', cut, RUNS, False)]


def way_out(way, wanted, refreshed):
    device = Device()
    with Board(PROGRAM, MAP % device.port) as it:
        assert until(lambda: device.has() == RUNS), (device.has(), it.command('status'))
        way(it, device)
        assert until(lambda: device.has() == wanted), device.has()
        assert until(lambda: is_quiet(device) != refreshed, 10), 'refreshed' if not refreshed else 'not refreshed'
        assert device.has() == wanted, device.has()
        if it.ladderd.poll() is not None:
            it.start_ladderd()
            assert until(lambda: device.has() == RUNS), 'the next ladderd drives it again'
    device.socket.close()


def main():
    if not os.path.exists(MODBUS):
        print('1..0 # SKIP built without ladder-modbus')
        return 0
    print(f'1..{len(WAYS)}', flush=True)
    failed = 0
    for number, (name, way, wanted, refreshed) in enumerate(WAYS, 1):
        try:
            way_out(way, wanted, refreshed)
            print(f'ok {number} - {name}', flush=True)
        except Exception as error:  # pylint: disable=broad-except
            failed = 1
            print(f'not ok {number} - {name}\n# {error!r}')
            print(''.join('# ' + line + '\n' for line in traceback.format_exc().splitlines()), flush=True)
    return failed


if __name__ == '__main__':
    sys.exit(main())
