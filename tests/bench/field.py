#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""field - figures of ladder-modbus: how much of a serial line's time it uses, what TCP costs, how fast it reacts, and what faults of a
wire do to inputs and scans.

The devices here only answer, in as few microseconds as Python can: the figures are those of ladder-modbus and ladderd.
With a limit that is missed it exits with 1.
"""
import os
import pty
import select
import socket
import struct
import sys
import threading
import time
import tty

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)) + '/../modbus')
from board import Board, crc, free_port, until  # noqa: E402

SECONDS = float(os.environ.get('SECONDS', '10'))
BAUD, BITS, QUIET = 115200, 11, 0.00175
failed = 0


def tell(what, value, limit, unit, good):
    global failed
    failed += not good
    print(f'{what:<60} {value:8.2f} {unit:<12} limit {limit}{"" if good else "   MISSED"}', flush=True)


def sleep_until(end):
    """The last millisecond is not slept: a timer of the kernel is not that exact."""
    left = end - time.perf_counter()
    if left > 0.001:
        time.sleep(left - 0.001)
    while time.perf_counter() < end:
        pass


class SerialUnits:
    """Sixteen units on a line of 115,200 baud. Each frame takes its time on the wire; a unit answers after 3.5 characters."""

    def __init__(self):
        self.master, slave = pty.openpty()
        tty.setraw(slave)
        self.port = os.ttyname(slave)
        self.slave = slave
        self.rounds, self.wire = [0] * 17, 0.0
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        char = BITS / BAUD
        while True:
            request = os.read(self.master, 256)
            came = time.perf_counter()
            unit, count = request[0], struct.unpack('>H', request[4:6])[0]
            frame = bytes([unit, request[1], 2 * count]) + bytes(2 * count)
            frame += crc(frame)
            needs = (len(request) + len(frame)) * char + QUIET
            sleep_until(came + needs)
            os.write(self.master, frame)
            self.rounds[unit] += 1
            self.wire += needs + QUIET


class TcpUnit:
    """Answers reads at once; measures the time from a change of its input 0 to the write of coil 0."""

    def __init__(self):
        self.listen = socket.create_server(('127.0.0.1', 0))
        self.port = self.listen.getsockname()[1]
        self.input = 0
        self.changed = 0.0
        self.times = []
        self.requests = 0
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        while True:
            stream, _where = self.listen.accept()
            stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            threading.Thread(target=self.serve, args=(stream,), daemon=True).start()

    def serve(self, stream):
        zeros = bytes(250)
        while True:
            data = stream.recv(300)
            if not data:
                return
            self.requests += 1
            function, _first, count = struct.unpack('>BHH', data[7:12])
            if function in (1, 2):
                body = bytes([function, 1, self.input])
            elif function in (3, 4):
                body = bytes([function, 2 * count]) + zeros[:2 * count]
            else:
                body = data[7:12]
                if function == 5 and self.changed and (count != 0) == self.input:
                    self.times.append(time.perf_counter() - self.changed)
                    self.changed = 0.0
            stream.sendall(data[:4] + struct.pack('>H', len(body) + 1) + data[6:7] + body)


def used(pid):
    with open(f'/proc/{pid}/stat', encoding='ascii') as file:
        fields = file.read().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def program(words):
    return ('RUNGBOARD 1\nPROJECT "Bench"\n\nCONFIGURATION Board\n  AREA I 8192;\n  AREA AI 8192;\n  AREA XI 8192;\n  TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);\n'
            '  PROGRAM Run WITH Fast : Main;\nEND_CONFIGURATION\n\nVAR_GLOBAL\n  In AT %IX0.0 : BOOL;\n  Out AT %QX0.0 : BOOL;\nEND_VAR\n\n'
            'PROGRAM Main LD\nRUNG\n  | NO In | COIL Out |\nEND_PROGRAM\n') if words else ''


def serial_line():
    units = SerialUnits()
    lines = ['BOARD "bench"', f'BUS rs485 modbus-rtu port={units.port} baud={BAUD} parity=even timeout=200ms', '%IX0.0 sim', '%QX0.0 sim safe=0']
    at = 2
    for unit in range(1, 17):
        count = 63 if unit <= 8 else 62
        lines.append(f'%IW{at}..{at + 2 * (count - 1)} modbus bus=rs485 unit={unit} holding-register=0 poll=1ms')
        at += 2 * count
    with Board(program(True), '\n'.join(lines) + '\n', '--period', '10ms'):
        assert until(lambda: min(units.rounds[1:]) > 2)
        began, rounds, wire = time.perf_counter(), sum(units.rounds), units.wire
        time.sleep(SECONDS)
        took, wire = time.perf_counter() - began, units.wire - wire
        rounds = (sum(units.rounds) - rounds) / 16
    tell('1,000 registers of 16 units, 115,200 baud: a round', took / rounds * 1000, f'{1.15 * wire / rounds * 1000:.2f}', 'ms', took <= 1.15 * wire)


def network():
    unit = TcpUnit()
    lines = ['BOARD "bench"', f'BUS plant modbus-tcp host=127.0.0.1:{unit.port}', '%IX0.0 sim', '%QX0.0 sim safe=0',
             '%IL8..8184 modbus bus=plant unit=1 holding-register=0 poll=100ms',
             '%AIL0..8184 modbus bus=plant unit=1 holding-register=4092 poll=100ms',
             '%XIL0..3616 modbus bus=plant unit=1 holding-register=8188 poll=100ms']
    with Board(program(True), '\n'.join(lines) + '\n', '--period', '10ms') as it:
        assert until(lambda: unit.requests > 160)
        began, cpu, requests = time.perf_counter(), used(it.modbus.pid), unit.requests
        daemon = used(it.ladderd.pid)
        time.sleep(SECONDS)
        took = time.perf_counter() - began
        cpu, daemon = (used(it.modbus.pid) - cpu) / took * 100, (used(it.ladderd.pid) - daemon) / took * 100
        rate = (unit.requests - requests) / took / 80
    tell('10,000 registers over TCP: rounds a second', rate, '9.5', '', rate >= 9.5)
    tell('… time of a processor, ladder-modbus', cpu, '10', '%', cpu <= 10)
    tell('… and ladderd with it', daemon, 'none', '%', True)


def reaction():
    unit = TcpUnit()
    board = (f'BOARD "bench"\nBUS plant modbus-tcp host=127.0.0.1:{unit.port}\n%IX0.0 modbus bus=plant unit=1 discrete-input=0 poll=5ms\n'
             '%QX0.0 modbus bus=plant unit=1 coil=0 safe=0\n')
    with Board(program(True), board, '--period', '10ms'):
        assert until(lambda: unit.requests > 20)
        for i in range(int(20 * SECONDS)):
            time.sleep(0.031 + i % 7 * 0.0013)
            unit.changed = time.perf_counter()
            unit.input ^= 1
            assert until(lambda: not unit.changed)
    times = sorted(unit.times)
    tell('a coil of a device to a coil of it, scan 10 ms: median', times[len(times) // 2] * 1000, '20', 'ms', times[len(times) // 2] < 0.020)
    tell('… of 100, 95 are faster than', times[len(times) * 95 // 100] * 1000, '20', 'ms', times[len(times) * 95 // 100] < 0.020)
    tell('… longest', times[-1] * 1000, 'none', 'ms', True)


# ---- faults ----

GUARDED = '''RUNGBOARD 1

VAR
  Level AT %IW0   : INT;
  Other AT %IW2   : INT;
  Good  AT %IX9.0 : BOOL;
  Full  AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main ST
  Full := Level > 5 AND Other > 5;
END_PROGRAM
'''
POLL, WAIT = 100, 50     # ms; three polls and two scans until a value has its substitute
ROUNDS = int(os.environ.get('ROUNDS', '10'))


def faults_of(far):
    """What begins a fault, and what ends it."""
    def damage(change):
        def begin(it):
            it.wire.damage = lambda frame: change(frame) if frame[0] == 3 else [(0, frame)]
        return begin

    def whole(it):
        it.wire.damage = None

    def other(frame):
        frame = bytes([frame[0] + 1]) + frame[1:-2]
        return [(0, frame + crc(frame))]

    def kill(it):
        it.modbus.kill()
        it.modbus.wait(60)

    return {
        'nothing': (lambda it: None, lambda it: None),
        'the cable is out': (lambda it: setattr(it.wire, 'down', True), lambda it: setattr(it.wire, 'down', False)),
        'checks of frames are wrong': (damage(lambda frame: [(0, frame[:-1] + bytes([frame[-1] ^ 1]))]), whole),
        'half frames': (damage(lambda frame: [(0, frame[:len(frame) // 2])]), whole),
        'another unit answers': (damage(other), whole),
        'the register is missing': (lambda it: it.units.block[3]['input-register'].missing.add(0),
                                    lambda it: it.units.block[3]['input-register'].missing.clear()),
        'the gateway is killed': (kill, lambda it: it.start_modbus()),
    }


def fault(machine, far, rt, begin, end, is_bad):
    """The longest times until the input has its substitute, and until it is good again; the lateness of scans in ms."""
    wire = far.Wire()
    units = far.Units([3, 4]).rtu(wire.theirs)
    units.set(3, 'input-register', 0, 1111)
    units.set(4, 'input-register', 0, 2222)
    io = (f'BOARD "bench"\nBUS rs485 modbus-rtu port={wire.ours} parity=none timeout={WAIT}ms\n'
          f'%IW0 modbus bus=rs485 unit=3 input-register=0 poll={POLL}ms stale={3 * POLL}ms substitute=-1\n'
          f'%IW2 modbus bus=rs485 unit=4 input-register=0 poll={POLL}ms\n%IX9.0 quality of=%IW0\n%QX0.0 sim safe=0\n')
    bad, back = [], []
    with machine(GUARDED, io, '--period', '10ms', *rt, gateway=True) as it:
        it.wire, it.units = wire, units
        assert until(lambda: it.desk.read('Level', 'Good', 'Full') == [1111, True, True])
        for i in range(ROUNDS):
            time.sleep(0.2 + i % 7 * 0.013)
            began = time.perf_counter()
            begin(it)
            if is_bad:
                assert until(lambda: it.desk.read('Level', 'Good') == [-1, False])
                bad.append((time.perf_counter() - began) * 1000)
            time.sleep(0.2)
            began = time.perf_counter()
            end(it)
            assert until(lambda: it.desk.read('Level', 'Good') == [1111, True])
            back.append((time.perf_counter() - began) * 1000)
        status = it.desk.status()
    units.close()
    wire.close()
    return max(bad, default=0), max(back), status['late_p999'] / 1e6, status['missed']


def faults():
    try:
        import far
        from plant import Machine
        from link import real_time
    except ImportError as why:
        print(f'faults are left out: {why}')
        return
    rt = real_time()
    quiet = 0
    for name, (begin, end) in faults_of(far).items():
        is_bad = name != 'nothing'
        # Other programs of this machine may delay a scan, too, but not each time.
        for _ in range(5):
            bad, back, late, missed = fault(Machine, far, rt, begin, end, is_bad)
            if not is_bad or late <= quiet + 0.3:
                break
        if is_bad:
            tell(f'{name}: the substitute is there after', bad, f'{3 * POLL + 20}', 'ms', bad <= 3 * POLL + 20)
            tell('… and the value again after', back, '2000', 'ms', back <= 2000)
        else:
            quiet = late
        tell(f"{'…' if is_bad else name + ':'} scans late, p99.9 ({missed} missed)", late, f'{quiet + 0.3:.2f}' if is_bad else 'none', 'ms', late <= quiet + 0.3)


for measure in (serial_line, network, reaction, faults):
    if len(sys.argv) < 2 or measure.__name__ in sys.argv[1:]:
        measure()
sys.exit(failed != 0)
