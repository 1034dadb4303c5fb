#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""field - ladder-modbus against programs of others: pymodbus and mbpoll, as units and as masters.

Serial lines are pseudo-terminals; a relay between them damages, delays and halves frames. All addresses are of this
machine. A test waits for what must come, never for a time.
"""
import contextlib
import json
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'online'))
from board import BUILD, MODBUS, Board, crc, free_port, until  # noqa: E402
from link import begin_limit, in_front  # noqa: E402
if not os.access(MODBUS, os.X_OK):
    print('1..0 # SKIP ladder-modbus is not built: it needs libmodbus')
    sys.exit(0)
try:
    import logging
    import far
    from far import Units, Wire
    from pymodbus.client import ModbusTcpClient
    logging.getLogger('pymodbus').setLevel(logging.CRITICAL)
    logging.getLogger('asyncio').setLevel(logging.CRITICAL)
except ImportError as why:
    print(f'1..0 # SKIP {why}: apt-get install python3-pymodbus python3-serial python3-serial-asyncio')
    sys.exit(0)

COPY = '''RUNGBOARD 1
PROJECT "Copy"

VAR
  In AT %IW0 : INT;
  Out AT %QW0 : INT;
  Switch AT %IX10.0 : BOOL;
  Lamp AT %QX10.0 : BOOL;
  Real1 AT %ID20 : REAL;
  Real2 AT %QD20 : REAL;
  Long1 AT %ID24 : DINT;
  Long2 AT %QD24 : DINT;
  Bit1 AT %IX30.0 : BOOL;
  Bit2 AT %QX30.0 : BOOL;
END_VAR

PROGRAM Main ST
  Out := In;
  Lamp := Switch;
  Real2 := Real1;
  Long2 := Long1;
  Bit2 := Bit1;
END_PROGRAM
'''


def run(*words, **options):
    return subprocess.run([MODBUS, *words], text=True, capture_output=True, timeout=60, check=False, **options)


def test_values_of_two_buses_go_both_ways():
    """A TCP bus and a serial one at once: bits, words, two registers in both orders, a bit of a register."""
    port = free_port()
    wire = Wire()
    plant, serial = Units([1, 2]).tcp(port), Units([3]).rtu(wire.theirs)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port} timeout=300ms
BUS rs485 modbus-rtu port={wire.ours} timeout=200ms
%IW0 modbus bus=plant unit=1 input-register=5 poll=20ms
%QW0 modbus bus=rs485 unit=3 holding-register=7 safe=-1
%IX10.0 modbus bus=rs485 unit=3 discrete-input=9 poll=20ms
%QX10.0 modbus bus=plant unit=2 coil=17 safe=0
%ID20 modbus bus=plant unit=1 holding-register=10 as=REAL poll=20ms
%QD20 modbus bus=plant unit=2 holding-register=20 as=REAL safe=0
%ID24 modbus bus=rs485 unit=3 input-register=30 poll=20ms
%QD24 modbus bus=plant unit=2 holding-register=30 byte-order=little safe=0
%IX30.0 modbus bus=plant unit=1 holding-register=40 bit=3 poll=20ms
%QX30.0 modbus bus=plant unit=2 holding-register=40 bit=9 safe=0
DEVICE plant unit=1 word-order=little
'''
    plant.set(2, 'holding-register', 40, 0x0101)
    with Board(COPY, board) as it:
        for value in (1, -2, 32767):
            plant.set(1, 'input-register', 5, value & 0xffff)
            assert until(lambda: serial.get(3, 'holding-register', 7) == value & 0xffff)
        for value in (1, 0, 1):
            serial.set(3, 'discrete-input', 9, value)
            assert until(lambda: plant.get(2, 'coil', 17) == value)
        high, low = struct.unpack('>HH', struct.pack('>f', -1.5))
        plant.set(1, 'holding-register', 10, low, high)
        assert until(lambda: plant.get(2, 'holding-register', 20, 2) == [high, low])
        serial.set(3, 'input-register', 30, 0x1234, 0x5678)
        assert until(lambda: plant.get(2, 'holding-register', 30, 2) == [0x3412, 0x7856])
        plant.set(1, 'holding-register', 40, 8)
        assert until(lambda: plant.get(2, 'holding-register', 40) == 0x0301)
        plant.set(1, 'holding-register', 40, 0xfff7)
        assert until(lambda: plant.get(2, 'holding-register', 40) == 0x0101)
        status = it.status()
        assert 'plant/1: answers' in status and 'rs485/3: answers' in status, status
        assert until(lambda: 'plant/1' in it.command('status')), it.command('status')
        # ladderd stops: safe values go out.
        it.ladderd.send_signal(signal.SIGTERM)
        it.ladderd.wait(60)
    for units in (plant, serial):
        units.close()
    wire.close()


def test_safe_values_come_when_the_program_stops():
    port = free_port()
    plant = Units([1]).tcp(port)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port}
%IW0 modbus bus=plant unit=1 input-register=0 poll=20ms
%QW0 modbus bus=plant unit=1 holding-register=1 safe=77 refresh=50ms
%QX10.0 modbus bus=plant unit=1 coil=2 safe=1
'''
    plant.set(1, 'input-register', 0, 5)
    with Board(COPY, board) as it:
        assert until(lambda: plant.get(1, 'holding-register', 1) == 5 and plant.get(1, 'coil', 2) == 0)
        it.command('stop')
        assert until(lambda: plant.get(1, 'holding-register', 1) == 77 and plant.get(1, 'coil', 2) == 1), it.command('status')
        it.command('run')
        assert until(lambda: plant.get(1, 'holding-register', 1) == 5 and plant.get(1, 'coil', 2) == 0)
        # ladderd is killed: nothing is refreshed any more, so that a watchdog of the far end can act.
        it.ladderd.kill()
        it.ladderd.wait(60)
        assert until(lambda: 'no ladderd answers' in it.read('modbus.out'))
        block = plant.block[1]['holding-register']

        def is_quiet():
            written = block.writes
            return not until(lambda: block.writes != written, 0.3)
        assert until(is_quiet)  # what was on its way when ladderd died has arrived by then
        before = block.writes
        it.start_ladderd()
        assert until(lambda: block.writes > before and plant.get(1, 'holding-register', 1) == 5)
        # The gateway is killed: the board goes on, and a new one takes over.
        it.modbus.kill()
        it.modbus.wait(60)
        plant.set(1, 'input-register', 0, 6)
        it.start_modbus()
        assert until(lambda: plant.get(1, 'holding-register', 1) == 6)
    plant.close()


def test_devices_that_take_less_and_function_23():
    """pymodbus as two units that write and read in one request, and one that takes four registers at a time."""
    port = free_port()
    wire = Wire()
    plant, serial = Units([1]).tcp(port), Units([2, 3]).rtu(wire.theirs)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port} timeout=300ms
BUS rs485 modbus-rtu port={wire.ours} timeout=200ms
DEVICE plant unit=1 together
DEVICE rs485 unit=2 together
DEVICE rs485 unit=3 read-registers=4
%IW0 modbus bus=plant unit=1 holding-register=5 poll=20ms
%QW0 modbus bus=rs485 unit=2 holding-register=7 safe=-1 refresh=50ms
%IW2 modbus bus=rs485 unit=2 holding-register=9 poll=20ms
%QW2 modbus bus=plant unit=1 holding-register=20 safe=0 refresh=50ms
%IW100..118 modbus bus=rs485 unit=3 holding-register=0 poll=20ms
'''
    program = '''RUNGBOARD 1

PROGRAM Main ST
  %QW0 := %IW0;
  %QW2 := %IW2;
END_PROGRAM
'''
    with Board(program, board) as it:
        for value in (1, -2, 32767):
            plant.set(1, 'holding-register', 5, value & 0xffff)
            serial.set(2, 'holding-register', 9, value + 5 & 0xffff)
            assert until(lambda: serial.get(2, 'holding-register', 7) == value & 0xffff and
                         plant.get(1, 'holding-register', 20) == value + 5 & 0xffff), it.status()
        assert until(lambda: plant.slave[1].functions.get(23, 0) > 5 and serial.slave[2].functions.get(23, 0) > 5)
        # Ten registers, four at a time: three requests.
        block = serial.block[3]['holding-register']
        before = block.reads
        assert until(lambda: block.reads >= before + 9)
        assert serial.slave[3].functions.keys() == {3}
        assert 'rs485/3: answers' in it.status()
    for units in (plant, serial):
        units.close()
    wire.close()


ASKING = '''RUNGBOARD 1

VAR
  Go     AT %MX0.0 : BOOL;
  Send   AT %MX0.1 : BOOL;
  Value  AT %MW2   : INT;
  Reads  AT %MW4   : INT;
  Writes AT %MW6   : INT;
  Errors AT %MW8   : INT;
  Why    AT %MW10  : UINT;
  Sum    AT %MD12  : DINT;
  Meter  : MB_READ;
  Drive  : MB_WRITE;
END_VAR

PROGRAM Main ST
  Meter(REQ := Go, TIMEOUT := T#3s);
  IF Meter.DONE AND Go THEN
    Sum := 0;
    Sum := Sum + %IW100 + %IW118;
    Reads := Reads + 1;
    Go := FALSE;
  ELSIF Meter.ERROR AND Go THEN
    Errors := Errors + 1;
    Why := Meter.STATUS;
    Go := FALSE;
  END_IF;
  %QW200 := Value;
  %QW202 := Value + 1;
  Drive(REQ := Send);
  IF Drive.DONE AND Send THEN
    Writes := Writes + 1;
    Send := FALSE;
  ELSIF Drive.ERROR AND Send THEN
    Errors := Errors + 1;
    Why := Drive.STATUS;
    Send := FALSE;
  END_IF;
END_PROGRAM
'''


def test_a_program_asks_for_what_it_reads_and_writes():
    """MB_READ and MB_WRITE: a device is asked only when the program wants it; good, refused, silent, another gateway."""
    port = free_port()
    plant = Units([1]).tcp(port)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port} timeout=300ms
DEVICE plant unit=1 read-registers=4
%IW100..118 modbus bus=plant unit=1 holding-register=0 ask=Meter
%QW200..202 modbus bus=plant unit=1 holding-register=20 ask=Main.Drive
'''
    board = board.replace('Main.Drive', 'Drive')
    block = plant.block[1]['holding-register']
    with Board(ASKING, board) as it:
        def word(name):
            return it.command('get', name).split('=')[1].split()[0]

        assert until(lambda: 'plant' in it.command('status'))
        plant.set(1, 'holding-register', 0, 7)
        plant.set(1, 'holding-register', 9, 8)
        assert not until(lambda: block.reads or block.writes, 0.5)
        for n in range(1, 4):
            plant.set(1, 'holding-register', 0, 7 * n)
            it.command('set', 'Go=1')
            assert until(lambda: word('Reads') == str(n)), it.status()
            assert word('Sum') == str(7 * n + 8)
            assert block.reads == 3 * n, block.reads
        for n in range(1, 4):
            it.command('set', f'Value={n}')
            assert not until(lambda: block.writes >= n, 0.2)
            it.command('set', 'Send=1')
            assert until(lambda: word('Writes') == str(n)), it.status()
            assert plant.get(1, 'holding-register', 20, 2) == [n, n + 1] and block.writes == n
        # A register that the device does not have.
        block.missing.add(9)
        it.command('set', 'Go=1')
        assert until(lambda: word('Errors') == '1') and word('Why') == '2', it.status()
        block.missing.clear()
        it.command('set', 'Go=1')
        assert until(lambda: word('Reads') == '4')
        # A gateway that begins anew makes no request that was answered.
        writes, reads = block.writes, block.reads
        it.modbus.kill()
        it.modbus.wait(60)
        it.start_modbus()
        assert until(lambda: 'plant/1' in it.command('status'))
        assert not until(lambda: (block.writes, block.reads) != (writes, reads), 0.5)
        # Without a gateway, and with a device that is silent.
        it.modbus.kill()
        it.modbus.wait(60)
        it.command('set', 'Go=1')
        assert until(lambda: word('Errors') == '2') and word('Why') == '256'
        it.start_modbus()
        assert until(lambda: 'plant/1' in it.command('status'))
        assert block.reads == reads
        plant.stop()
        it.command('set', 'Send=1')
        assert until(lambda: word('Errors') == '3') and word('Why') == '257', (word('Errors'), word('Why'))
        plant.tcp(port)
        it.command('set', 'Send=1')
        assert until(lambda: word('Writes') == '4'), it.status()
    plant.close()


def late(frame):
    return [(0.15, frame)]


def half(frame):
    return [(0, frame[:len(frame) // 2])]


def two_halves(frame):
    return [(0, frame[:3]), (0.3, frame[3:])]


def wrong_check(frame):
    return [(0, frame[:-1] + bytes([frame[-1] ^ 1]))]


def other_unit(frame):
    return [(0, bytes([frame[0] + 1]) + frame[1:-2] + crc(bytes([frame[0] + 1]) + frame[1:-2]))]


def with_noise(frame):
    return [(0, b'\xff\x00' + frame)]


def short(frame):
    return [(0, frame[:-4] + crc(frame[:-4]))]


def nothing(_frame):
    return []


def test_damaged_frames_are_never_taken_for_values():
    """Two registers of one unit in two requests of the same form, and each kind of damage to half of the frames."""
    wire = Wire()
    serial = Units([3, 4]).rtu(wire.theirs)
    board = f'''BOARD "on a table"
BUS rs485 modbus-rtu port={wire.ours} timeout=100ms
%IW0 modbus bus=rs485 unit=3 input-register=0 poll=10ms
%IW2 modbus bus=rs485 unit=3 input-register=150 poll=10ms
%IW4 modbus bus=rs485 unit=4 input-register=0 poll=10ms
%QW0 sim
%QW2 sim
SERVE look modbus-tcp listen=127.0.0.1:{{port}}
WINDOW look holding-register=0..9 %MW0 read-write
'''
    program = '''RUNGBOARD 1
PROJECT "Mixed"

VAR
  A AT %IW0 : INT;
  B AT %IW2 : INT;
  C AT %IW4 : INT;
  Wrong AT %MW0 : INT;
  Fresh AT %MW2 : INT;
END_VAR

PROGRAM Main ST
  IF A <> 0 AND A <> 1111 AND A <> 1112 OR B <> 0 AND B <> 2222 OR C <> 0 AND C <> 3333 THEN
    Wrong := Wrong + 1;
  END_IF;
  Fresh := A;
END_PROGRAM
'''
    port = free_port()
    serial.set(3, 'input-register', 0, 1111)
    serial.set(3, 'input-register', 150, 2222)
    serial.set(4, 'input-register', 0, 3333)
    with Board(program, board.replace('{port}', str(port))) as it:
        client = ModbusTcpClient('127.0.0.1', port=port)

        def word(at):
            answer = client.read_holding_registers(at, 1, slave=1) if client.connect() else None
            return answer.registers[0] if answer and not answer.isError() else None

        assert until(lambda: word(1) == 1111), word(1)
        for damage in (late, half, two_halves, wrong_check, other_unit, with_noise, short, nothing):
            seen = wire.seen
            wire.damage = lambda frame, damage=damage: damage(frame) if wire.seen % 2 else [(0, frame)]
            assert until(lambda: wire.seen > seen + 12), damage.__name__
            wire.damage = None
            serial.set(3, 'input-register', 0, 1112)
            assert until(lambda: word(1) == 1112, 5), damage.__name__
            serial.set(3, 'input-register', 0, 1111)
            assert until(lambda: word(1) == 1111, 5), (damage.__name__, word(1), word(0), it.status(), wire.seen)
        assert word(0) == 0, word(0)
        status = it.status()
        for counted in ('time-outs 0', 'wrong checks 0', 'wrong frames 0'):
            assert counted not in status.split('rs485/4')[0], status
        # The cable is out: bad within three polls, and good again within two seconds.
        wire.down = True
        assert until(lambda: 'rs485/3: silent' in it.status())
        wire.down = False
        began = time.monotonic()
        serial.set(3, 'input-register', 0, 1112)
        assert until(lambda: word(1) == 1112)
        assert time.monotonic() - began < 10, time.monotonic() - began
        assert word(0) == 0
        client.close()
    serial.close()
    wire.close()


def test_a_silent_unit_and_a_missing_register_harm_no_other():
    port = free_port()
    plant = Units([1, 2]).tcp(port)
    plant.block[1]['input-register'].missing.add(3)
    wire = Wire()
    serial = Units([5]).rtu(wire.theirs)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port} timeout=300ms
BUS rs485 modbus-rtu port={wire.ours} timeout=150ms
%IW0..12 modbus bus=plant unit=1 input-register=0 poll=20ms
%QW0 modbus bus=plant unit=2 holding-register=1 safe=0
%IW20 modbus bus=rs485 unit=5 input-register=0 poll=20ms
%IW22 modbus bus=rs485 unit=6 input-register=0 poll=20ms
%IW24 modbus bus=rs485 unit=7 input-register=0 poll=20ms
'''
    plant.set(1, 'input-register', 0, 10)
    with Board(COPY, board) as it:
        assert until(lambda: plant.get(2, 'holding-register', 1) == 10)
        plant.set(1, 'input-register', 0, 11)
        assert until(lambda: plant.get(2, 'holding-register', 1) == 11)
        assert until(lambda: 'rs485/6: silent' in it.status() and 'rs485/7: silent' in it.status())
        reads = serial.block[5]['input-register'].reads
        assert until(lambda: serial.block[5]['input-register'].reads > reads + 50)
        status = it.status()
        assert 'rs485/5: answers' in status and 'exception 2: ' in status, status
        # The host goes away and comes back.
        plant.stop()
        assert until(lambda: 'plant/1: silent' in it.status())
        plant.tcp(port)
        plant.set(1, 'input-register', 0, 12)
        began = time.monotonic()
        assert until(lambda: plant.get(2, 'holding-register', 1) == 12)
        assert time.monotonic() - began < 10
    plant.close()
    serial.close()
    wire.close()


PUMP = '''RUNGBOARD 1
PROJECT "Pump"

VAR
  Level AT %IW0 : INT;
  Pump AT %QX0.0 : BOOL;
  Wanted AT %MW0 : INT;
  Secret AT %MW20 : INT := 4711;
END_VAR

PROGRAM Main ST
  Pump := Wanted > 5;
END_PROGRAM
'''


def pump_map(port):
    return f'''BOARD "Pump house"
SERVE plc modbus-tcp listen=127.0.0.1:{port} unit=1 connections=2
WINDOW plc coil=0..7 %QX0.0 read-only
WINDOW plc holding-register=0..3 %MW0 read-write
WINDOW plc input-register=0..3 %IW0 read-only
%QX0.0 sim safe=0
%IW0 sim
'''


def take(stream, count):
    got = b''
    while len(got) < count:
        more = stream.recv(count - len(got))
        if not more:
            raise ConnectionResetError('the server has closed the connection')
        got += more
    return got


def exchange(stream, pdu, unit=1):
    """One request of TCP as bytes; the PDU that comes back."""
    stream.sendall(struct.pack('>HHHB', 7, 0, len(pdu) + 1, unit) + pdu)
    number, protocol, length, answered = struct.unpack('>HHHB', take(stream, 7))
    assert (number, protocol, answered) == (7, 0, unit)
    return take(stream, length - 1)


def joined(port):
    """A connection that is served. One that was closed a moment ago may still count."""
    def connect():
        stream = None
        try:
            stream = socket.create_connection(('127.0.0.1', port))
            stream.settimeout(20)
            exchange(stream, b'\x03\x00\x00\x00\x01')
            return stream
        except OSError:
            if stream:
                stream.close()
            return None

    stream = until(connect)
    assert stream, 'no connection is served'
    return stream


def test_masters_see_and_change_what_the_map_declares():
    """pymodbus and mbpoll as masters; then all functions at sampled addresses: only the window changes."""
    port = free_port()
    with Board(PUMP, pump_map(port)) as it:
        client = ModbusTcpClient('127.0.0.1', port=port)
        assert until(client.connect), it.read('modbus.out')
        assert client.read_coils(0, 8, slave=1).bits == [False] * 8
        assert not client.write_register(0, 9, slave=1).isError()
        assert until(lambda: client.read_coils(0, 8, slave=1).bits[0])
        assert client.read_holding_registers(0, 4, slave=1).registers == [9, 0, 0, 0]
        assert not client.write_registers(1, [7, 8], slave=1).isError()
        assert not client.mask_write_register(1, 0xfff0, 5, slave=1).isError()
        assert client.read_holding_registers(0, 4, slave=1).registers == [9, 5, 8, 0]
        answer = client.readwrite_registers(read_address=1, read_count=2, write_address=3, write_registers=[3], slave=1)
        assert answer.registers == [5, 8]
        assert client.write_coil(0, True, slave=1).exception_code == 2
        assert client.read_holding_registers(3, 2, slave=1).exception_code == 2
        assert client.read_discrete_inputs(0, 1, slave=1).exception_code == 2
        assert client.read_holding_registers(0, 1, slave=9).exception_code == 11
        if shutil.which('mbpoll'):
            done = subprocess.run(['mbpoll', '-1', '-0', '-a', '1', '-t', '4', '-r', '0', '-c', '3', '-p', str(port),
                                   '127.0.0.1'], text=True, capture_output=True, timeout=60, check=False)
            assert '[0]: \t9' in done.stdout and '[2]: \t8' in done.stdout, done.stdout + done.stderr
            done = subprocess.run(['mbpoll', '-1', '-0', '-a', '1', '-t', '4', '-r', '0', '-p', str(port), '127.0.0.1', '--', '4'],
                                  text=True, capture_output=True, timeout=60, check=False)
            assert until(lambda: client.read_holding_registers(0, 1, slave=1).registers == [4]), done.stdout + done.stderr
        client.close()
        contain(port)
        limits(port)


def contain(port):
    with joined(port) as stream:
        before = exchange(stream, b'\x03\x00\x00\x00\x04')
        changed = 0
        for function in list(range(1, 128)):
            for at in (0, 1, 3, 4, 7, 8, 9, 255, 4096, 65534, 65535):
                known = function in (1, 2, 3, 4, 5, 6, 15, 16, 22, 23)
                place = struct.pack('>H', at)
                body = {5: place + b'\xff\x00', 6: place + b'\x12\x34', 15: place + b'\x00\x02\x01\x03',
                        16: place + b'\x00\x02\x04\x00\x01\x00\x02', 22: place + b'\x00\x00\x12\x34',
                        23: b'\x00\x00\x00\x01' + place + b'\x00\x01\x02\x12\x34'}.get(function, place + b'\x00\x01')
                answer = exchange(stream, bytes([function]) + body)
                if not known:
                    assert answer == bytes([function | 128, 1]), (function, at, answer)
                    continue
                last = at + (1 if function in (15, 16) else 0)
                may = {1: last < 8, 3: last < 4, 4: last < 4, 6: last < 4, 16: last < 4, 22: last < 4, 23: last < 4}.get(function)
                assert answer[0] == (function if may else function | 128), (function, at, answer)
                assert may or answer[1] == 2, (function, at, answer)
                changed += bool(may) and function in (6, 16, 22, 23)
        assert changed > 8
        # What no window shows is as it was; the window itself can be set back.
        registers = before[2:]
        assert exchange(stream, b'\x10\x00\x00\x00\x04\x08' + registers) == b'\x10\x00\x00\x00\x04'
        assert exchange(stream, b'\x03\x00\x00\x00\x04') == before


def limits(port):
    """More connections than the map allows, bytes that are no Modbus, and a frame that comes byte by byte."""
    with joined(port) as one, joined(port) as two:
        assert exchange(one, b'\x03\x00\x00\x00\x01') and exchange(two, b'\x03\x00\x00\x00\x01')
        with socket.create_connection(('127.0.0.1', port)) as three:
            three.settimeout(20)
            try:
                assert three.recv(1) == b''
            except ConnectionResetError:
                pass
        for byte in struct.pack('>HHHB', 7, 0, 6, 1) + b'\x03\x00\x00\x00':
            two.sendall(bytes([byte]))
        assert exchange(one, b'\x03\x00\x00\x00\x01')
        two.sendall(b'\x01')
        assert len(two.recv(100)) == 11
        two.sendall(b'GET / HTTP/1.0\r\n\r\n')
        two.settimeout(20)
        assert two.recv(1) == b''


def test_a_master_that_asks_too_often_waits():
    """rate=50 and its burst of one second: 150 requests take two seconds at least, and each is answered."""
    port = free_port()
    with Board(PUMP, pump_map(port).replace('connections=2', 'connections=2 rate=50')):
        with joined(port) as stream:
            began = time.monotonic()
            for _ in range(150):
                assert exchange(stream, b'\x03\x00\x00\x00\x01')[0] == 3
            took = time.monotonic() - began
            assert took > 1.9, took


def test_other_programs_and_other_maps():
    """A download of a program with the same map cuts no connection; one with another map begins anew."""
    port = free_port()
    with Board(PUMP, pump_map(port), '--slots', '.') as it:
        stream = joined(port)
        exchange(stream, b'\x06\x00\x00\x00\x04')
        assert exchange(stream, b'\x01\x00\x00\x00\x01') == b'\x01\x01\x00'
        it.write('other.rung', PUMP.replace('Wanted > 5', 'Wanted > 3'))
        said = it.command('download', 'other.rung', 'board.io', '--yes')
        assert until(lambda: exchange(stream, b'\x01\x00\x00\x00\x01') == b'\x01\x01\x01'), said
        it.write('wide.io', pump_map(port).replace('holding-register=0..3', 'holding-register=0..4'))
        said = it.command('download', 'other.rung', 'wide.io', '--yes')
        assert until(lambda: stream.recv(1) == b''), said
        stream.close()
        stream = joined(port)
        assert exchange(stream, b'\x03\x00\x04\x00\x01')[0] == 3
        stream.close()


def test_a_gateway_that_is_killed_again_and_again():
    port = free_port()
    plant = Units([1]).tcp(port)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port}
%IW0 modbus bus=plant unit=1 input-register=0 poll=5ms
%QW0 modbus bus=plant unit=1 holding-register=0 safe=0
'''
    with Board(COPY, board) as it:
        for value in range(1, 31):
            plant.set(1, 'input-register', 0, value)
            assert until(lambda: plant.get(1, 'holding-register', 0) == value), it.read('modbus.out')
            it.modbus.kill()
            it.modbus.wait(60)
            it.start_modbus()
        assert 'fault: none' in it.command('status')
    plant.close()


def test_a_server_on_a_serial_line():
    """The map of a board as unit 5 of a line that other units share."""
    wire = Wire()
    board = f'''BOARD "Pump house"
SERVE old modbus-rtu port={wire.ours} baud=19200 unit=5
WINDOW old holding-register=0..3 %MW0 read-write
%QX0.0 sim safe=0
%IW0 sim
'''
    with Board(PUMP, board):
        line = os.open(wire.theirs, os.O_RDWR | os.O_NOCTTY)

        def ask(*pdu, unit=5, answers=True):
            frame = bytes([unit, *pdu])
            os.write(line, frame + crc(frame))
            got = b''
            end = time.monotonic() + (1 if answers else 0.15)
            while time.monotonic() < end and not (len(got) > 4 and crc(got[:-2]) == got[-2:]):
                if far.select.select([line], [], [], 0.02)[0]:
                    got += os.read(line, 256)
            return got[1:-2]

        assert until(lambda: ask(3, 0, 0, 0, 2) == b'\x03\x04\0\0\0\0')
        assert ask(6, 0, 1, 0x12, 0x34) == b'\x06\0\x01\x12\x34'
        assert ask(3, 0, 0, 0, 2, unit=6, answers=False) == b''
        assert ask(3, 4, 1, 2, 3, 4, unit=6, answers=False) == b''
        assert ask(3, 0, 0, 0, 2) == b'\x03\x04\0\0\x12\x34'
        assert ask(3, 0, 3, 0, 2) == b'\x83\x02'
        assert ask(8, 0, 0, 1, 2) == b'\x88\x01'
        assert ask(6, 0, 1, 0x43, 0x21, unit=0, answers=False) == b''
        assert ask(3, 0, 1, 0, 1) == b'\x03\x02\x43\x21'
        os.close(line)
    wire.close()


class Lacking(Exception):
    """A program of others that is not on this machine."""


class Socat:
    """Two pseudo-terminals that socat joins, as people do who have no adapter. `end` pulls the cable: both vanish."""

    def __init__(self):
        if not shutil.which('socat'):
            raise Lacking('apt-get install socat')
        self.folder = tempfile.mkdtemp()
        self.ours, self.theirs = self.folder + '/ours', self.folder + '/theirs'
        self.process = None
        self.begin()

    def begin(self):
        self.process = subprocess.Popen(['socat', f'pty,raw,echo=0,link={self.ours}', f'pty,raw,echo=0,link={self.theirs}'])
        assert until(lambda: os.path.exists(self.ours) and os.path.exists(self.theirs))

    def end(self):
        self.process.terminate()
        self.process.wait(60)

    def close(self):
        self.end()
        shutil.rmtree(self.folder)


def test_a_line_of_socat():
    """Units of pymodbus behind socat; its cable is pulled, and it comes back under the same names."""
    wire = Socat()
    serial = Units([3]).rtu(wire.theirs)
    board = f'''BOARD "a line of socat"
BUS rs485 modbus-rtu port={wire.ours} parity=none timeout=200ms
%IW0 modbus bus=rs485 unit=3 input-register=5 poll=20ms stale=300ms substitute=99
%QW0 modbus bus=rs485 unit=3 holding-register=7 safe=-1
%IX10.0 modbus bus=rs485 unit=3 discrete-input=9 poll=20ms
%QX10.0 modbus bus=rs485 unit=3 coil=11 safe=0
'''
    with Board(COPY, board) as it:
        for value in (1, -2, 32767):
            serial.set(3, 'input-register', 5, value & 0xffff)
            serial.set(3, 'discrete-input', 9, value & 1)
            assert until(lambda: (serial.get(3, 'holding-register', 7), serial.get(3, 'coil', 11)) == (value & 0xffff, value & 1)), it.status()
        before = it.command('status')
        serial.close()
        wire.end()
        assert until(lambda: re.search(r'Out\D+99\b', it.command('get', 'Out'))), it.command('get', 'Out')
        wire.begin()
        serial = Units([3]).rtu(wire.theirs)
        serial.set(3, 'input-register', 5, 4)
        assert until(lambda: serial.get(3, 'holding-register', 7) == 4), it.status()
        assert 'mode: RUN' in it.command('status'), (before, it.command('status'))
    serial.close()
    wire.close()


def test_mbpoll_on_a_line_of_socat():
    """mbpoll as the master of a board that is unit 5 of a line: it reads and writes; another unit does not answer."""
    if not shutil.which('mbpoll'):
        raise Lacking('apt-get install mbpoll')
    wire = Socat()
    board = f'''BOARD "Pump house"
SERVE old modbus-rtu port={wire.ours} baud=19200 parity=none unit=5
WINDOW old holding-register=0..3 %MW0 read-write
WINDOW old coil=0..7 %QX0.0 read-only
%QX0.0 sim safe=0
%IW0 sim
'''

    def mbpoll(*words, unit=5):
        return subprocess.run(['mbpoll', '-m', 'rtu', '-b', '19200', '-P', 'none', '-1', '-0', '-o', '0.5', '-a', str(unit), *words],
                              text=True, capture_output=True, timeout=60, check=False)

    with Board(PUMP, board) as it:
        assert until(lambda: mbpoll('-t', '4', '-r', '0', wire.theirs).returncode == 0), it.read('modbus.out')
        done = mbpoll('-t', '4', '-r', '0', wire.theirs, '--', '9', '7', '65534')
        assert done.returncode == 0, done.stdout + done.stderr
        done = mbpoll('-t', '4', '-r', '0', '-c', '4', wire.theirs)
        assert re.findall(r'\[(\d)\]: \t(\d+)', done.stdout) == [('0', '9'), ('1', '7'), ('2', '65534'), ('3', '0')], done.stdout + done.stderr
        assert until(lambda: '[0]: \t1' in mbpoll('-t', '0', '-r', '0', wire.theirs).stdout), done.stdout
        done = mbpoll('-t', '0', '-r', '0', wire.theirs, '--', '0')
        assert done.returncode != 0 and 'Illegal data address' in done.stderr, done.stdout + done.stderr
        done = mbpoll('-t', '4', '-r', '3', '-c', '2', wire.theirs)
        assert done.returncode != 0 and 'Illegal data address' in done.stderr, done.stdout + done.stderr
        done = mbpoll('-t', '4', '-r', '0', wire.theirs, unit=6)
        assert done.returncode != 0 and 'timed out' in done.stderr, done.stdout + done.stderr
    wire.close()


def test_adapters_are_pulled_and_come_back():
    """The devices of two serial lines vanish, that of a bus and that of a server, and others take their names."""
    folder = tempfile.mkdtemp()

    def plug(name):
        wire = Wire()
        os.symlink(wire.ours, f'{folder}/new')
        os.rename(f'{folder}/new', f'{folder}/{name}')
        return wire

    bus, panel = plug('bus'), plug('panel')
    serial = Units([3]).rtu(bus.theirs)
    serial.set(3, 'input-register', 0, 3)
    board = f'''BOARD "Pump house"
BUS rs485 modbus-rtu port={folder}/bus timeout=200ms
SERVE old modbus-rtu port={folder}/panel unit=5
WINDOW old input-register=0..0 %IW0 read-only
%IW0 modbus bus=rs485 unit=3 input-register=0 poll=20ms substitute=99 stale=300ms
%QX0.0 sim safe=0
'''

    def level(wire):
        line = os.open(wire.theirs, os.O_RDWR | os.O_NOCTTY)
        frame = b'\x05\x04\0\0\0\x01'
        os.write(line, frame + crc(frame))
        got = os.read(line, 256) if far.select.select([line], [], [], 0.3)[0] else b''
        os.close(line)
        return got[3] << 8 | got[4] if len(got) == 7 else None

    with Board(PUMP, board) as it:
        assert until(lambda: level(panel) == 3), level(panel)
        serial.close()
        bus.close()
        assert until(lambda: level(panel) == 99), level(panel)
        panel.close()
        bus, panel = plug('bus'), plug('panel')
        serial = Units([3]).rtu(bus.theirs)
        serial.set(3, 'input-register', 0, 4)
        assert until(lambda: level(panel) == 4), it.status()
    serial.close()
    bus.close()
    panel.close()
    shutil.rmtree(folder)


def test_what_a_machine_lacks_is_told():
    wire = Wire()
    folder = tempfile.mkdtemp()
    busy = socket.create_server(('127.0.0.1', 0))
    holder = os.open(wire.theirs, os.O_RDWR | os.O_NOCTTY)
    far.tty.setraw(holder)
    import fcntl
    fcntl.flock(holder, fcntl.LOCK_EX)
    os.symlink(wire.ours, folder + '/adapter')
    with open(folder + '/board.io', 'w', encoding='utf-8') as out:
        out.write(f'''BOARD "on a table"
BUS a modbus-rtu port=/dev/no-such-line
BUS b modbus-rtu port={wire.ours}
BUS c modbus-rtu port={folder}/adapter
BUS d modbus-rtu port={wire.theirs}
BUS e modbus-rtu port={folder}/board.io
BUS f modbus-tcp host=no-such-host.invalid
SERVE g modbus-tcp listen=127.0.0.1:{busy.getsockname()[1]}
SERVE h modbus-tcp listen=192.0.2.1:1502
SERVE i modbus-tcp listen=127.0.0.1:1
''')
    user = {'user': 65534, 'group': 65534, 'extra_groups': []} if os.getuid() == 0 else {}
    os.chmod(folder, 0o755)
    os.chmod(wire.ours, 0o666)
    os.chmod(wire.theirs, 0o666)
    os.chmod(folder + '/board.io', 0o666)
    done = run('--check', folder + '/board.io', **user)
    lines = [line.split(': ')[0].split('/')[-1] + ' ' + line.split('error ')[1].split(':')[0] for line in done.stderr.splitlines()]
    unprivileged = int(open('/proc/sys/net/ipv4/ip_unprivileged_port_start', encoding='ascii').read()) > 1
    wanted = ['board.io:2:1 LD560', 'board.io:4:1 LD564', 'board.io:5:1 LD565', 'board.io:6:1 LD566', 'board.io:7:1 LD562',
              'board.io:8:1 LD563', 'board.io:9:1 LD568'] + ['board.io:10:1 LD567'] * unprivileged
    assert lines == wanted and done.returncode == 1, done.stderr
    # `ladder io` finds the same, and the networks of boards.
    with open(folder + '/board.io', 'a', encoding='utf-8') as out:
        out.write('BUS j peer interface=nowhere0\n%IX0.0 gpio line=NOWHERE\n')
    done = subprocess.run([BUILD + '/ladder', 'io', folder + '/board.io'], text=True, capture_output=True, timeout=60, check=False, **user)
    for place in wanted + ['board.io:11:1 LD875', 'board.io:12:1 LD508']:
        assert re.search(place.replace(' ', ': error '), done.stderr), (place, done.stderr)
    assert done.returncode == 1 and 'nowhere0": this machine has no such network interface; it has ' in done.stderr, done.stderr
    if user:
        os.chmod(wire.ours, 0o600)
        with open(folder + '/board.io', 'w', encoding='utf-8') as out:
            out.write(f'BOARD "on a table"\nBUS b modbus-rtu port={wire.ours}\n')
        done = run('--check', folder + '/board.io', **user)
        assert 'board.io:2:1: error LD561' in done.stderr and 'dialout' in done.stderr, done.stderr
    done = run('--check', folder + '/board.io')
    assert not user or (done.returncode == 0 and done.stdout.endswith('board.io: good\n')), done.stderr
    os.close(holder)
    busy.close()
    wire.close()
    shutil.rmtree(folder)


def test_a_unit_that_answers_for_another_is_told():
    """Once, with the line of the map, until it answers itself; others go on."""
    wire = Wire()
    serial = Units([3, 5]).rtu(wire.theirs)
    serial.set(5, 'input-register', 0, 55)
    board = f'''BOARD "on a table"
BUS rs485 modbus-rtu port={wire.ours} timeout=60ms
%QW0 sim
%IW0 modbus bus=rs485 unit=5 input-register=0 poll=20ms
%IW20 modbus bus=rs485 unit=3 input-register=1 poll=20ms
'''
    wire.damage = lambda frame: other_unit(frame) if frame[0] == 3 else [(0, frame)]
    with Board(COPY, board) as it:
        told = 'ladder-modbus: map of the board:5:1: error LD876: "rs485/3": '
        assert until(lambda: told in it.read('modbus.out')), it.read('modbus.out')
        assert until(lambda: 'LD876: rs485/3' in it.command('status')), it.command('status')
        assert until(lambda: 'In=55' in it.command('get', 'In')), it.command('get', 'In')
        wire.damage = None
        assert until(lambda: 'rs485/3: answers' in it.status())
        assert until(lambda: 'LD876' not in it.command('status')), it.command('status')
        wire.damage = lambda frame: other_unit(frame) if frame[0] == 3 else [(0, frame)]
        assert until(lambda: it.read('modbus.out').count(told) == 2), it.read('modbus.out')
        # A unit that is only silent is another matter.
        wire.damage = lambda frame: [] if frame[0] == 3 else [(0, frame)]
        assert 'rs485/5' not in ''.join(line for line in it.read('modbus.out').splitlines() if 'LD876' in line)
    serial.close()
    wire.close()


def test_nothing_is_driven_until_all_is_right():
    """A port that is taken: neither bus nor server begins, and the reason is told; then all of it begins."""
    port, busy = free_port(), socket.create_server(('127.0.0.1', 0))
    taken = busy.getsockname()[1]
    plant = Units([1]).tcp(port)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port}
SERVE plc modbus-tcp listen=127.0.0.1:{taken}
%IW0 modbus bus=plant unit=1 input-register=0 poll=20ms
%QW0 modbus bus=plant unit=1 holding-register=1 safe=0
'''
    with Board(COPY, board) as it:
        assert until(lambda: 'LD563' in it.read('modbus.out')), it.read('modbus.out')
        assert until(lambda: 'LD563' in it.command('status')), it.command('status')
        blocks = plant.block[1]
        assert blocks['input-register'].reads == 0 and blocks['holding-register'].writes == 0
        busy.close()
        assert until(lambda: blocks['input-register'].reads > 0 and blocks['holding-register'].writes > 0)
    plant.close()


LAMP = '''RUNGBOARD 1

VAR
  Level AT %IW0 : INT;
  Lamp AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main ST
  Lamp := Level >= 0;
END_PROGRAM
'''


def test_a_serial_line_that_is_not_there_at_the_start_drives_nothing():
    """ladderd drives no local output either. It tells the other errors of the map, too, and waits some seconds for an adapter."""
    folder = tempfile.mkdtemp()
    wire = Wire()
    serial = Units([3]).rtu(wire.theirs)
    serial.set(3, 'input-register', 0, 3)

    def start(more, port='adapter'):
        with open(folder + '/lamp.rung', 'w', encoding='utf-8') as out:
            out.write(LAMP)
        with open(folder + '/lamp.io', 'w', encoding='utf-8') as out:
            out.write(f'BOARD "Lamp"\nBUS rs485 modbus-rtu port={folder}/{port} timeout=200ms\n%QX0.0 sim safe=0\n'
                      f'%IW0 modbus bus=rs485 unit=3 input-register=0 poll=20ms\n{more}')
        return subprocess.Popen([BUILD + '/ladderd', 'lamp.rung', '--io', 'lamp.io', '--trace-io'], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    told = start('%IX30.0 gpio line=NOWHERE\nBUS b modbus-rtu port=' + folder + '/lamp.io\n')
    said = told.communicate(timeout=60)[1]
    assert told.returncode == 1 and '%QX0.0' not in said, said
    for place in ('lamp.io:2:1: error LD560', 'lamp.io:5:1: error LD508', 'lamp.io:6:1: error LD566'):
        assert place in said, (place, said)
    # One that is there a moment later.
    late = start('')
    assert 'waits up to 10 s' in late.stderr.readline()
    os.symlink(wire.ours, folder + '/adapter')
    assert '%QX0.0 1' in ''.join(iter(lambda: late.stderr.readline(), '%QX0.0 1\n')) + '%QX0.0 1'
    late.send_signal(signal.SIGTERM)
    late.communicate(timeout=60)
    # A program that waits ends when it is told so.
    os.remove(folder + '/adapter')
    ended = start('')
    assert 'waits up to 10 s' in ended.stderr.readline()
    began = time.monotonic()
    ended.send_signal(signal.SIGTERM)
    ended.communicate(timeout=60)
    assert time.monotonic() - began < 9, 'SIGTERM ends it'
    serial.close()
    wire.close()
    shutil.rmtree(folder)


def test_an_adapter_that_is_gone_hinders_no_download():
    """Another program goes on with the map that runs; a map with another line that is not there is refused before it drives anything."""
    folder = tempfile.mkdtemp()
    wire = Wire()
    os.symlink(wire.ours, folder + '/adapter')
    board = f'''BOARD "Lamp"
BUS rs485 modbus-rtu port={folder}/adapter timeout=200ms
%IW0 modbus bus=rs485 unit=3 input-register=0 poll=20ms
%QX0.0 sim safe=0
'''
    with Board(LAMP, board, '--slots', '.') as it:
        assert until(lambda: 'RUN' in it.command('status')), it.command('status')
        os.remove(folder + '/adapter')
        it.write('other.rung', LAMP.replace('>= 0', '>= 7'))
        said = it.command('download', 'other.rung', 'board.io', '--yes')
        assert until(lambda: 'another program runs' in it.read('ladderd.out')), said
        it.write('wide.io', board + 'BUS more modbus-rtu port=/dev/no-such-line\n')
        said = it.command('download', 'program.rung', 'wide.io', '--yes')
        assert 'no-such-line' in said and 'LD' in said, said
        assert 'no-such-line' not in it.command('status')
    wire.close()
    shutil.rmtree(folder)


def test_units_are_found():
    port = free_port()
    plant = Units([3, 9]).tcp(port)
    done = run('scan', '--host', f'127.0.0.1:{port}', '--to', '12', '--json', '--timeout', '200')
    assert [unit['unit'] for unit in json.loads(done.stdout)['units']] == [3, 9], done.stdout + done.stderr
    wire = Wire()
    serial = Units([2, 4]).rtu(wire.theirs)
    serial.block[4]['holding-register'].missing.add(0)
    folder = tempfile.mkdtemp()
    with open(folder + '/board.io', 'w', encoding='utf-8') as out:
        out.write(f'BOARD "x"\nBUS rs485 modbus-rtu port={wire.ours} timeout=60ms\n')
    done = run('scan', 'rs485', folder + '/board.io', '--to', '5')
    assert [line.split()[1] for line in done.stdout.splitlines()] == ['2', '4'] and 'exception 2' in done.stdout, done.stdout + done.stderr
    done = run('scan', 'other', folder + '/board.io')
    assert done.returncode == 2 and 'is no bus' in done.stderr
    shutil.rmtree(folder)
    serial.close()
    plant.close()
    wire.close()


def lines_of(done):
    return done.stdout.splitlines()


def test_a_scan_tells_exceptions():
    """A unit that refuses is there: what it says is told in words. One behind a gateway that is away is not there."""
    port = free_port()
    plant = Units([3, 9]).tcp(port)
    plant.block[9]['holding-register'].missing.add(0)
    done = run('scan', '--host', f'127.0.0.1:{port}', '--to', '12', '--timeout', '200')
    assert done.returncode == 0 and len(lines_of(done)) == 2 and not done.stderr, done.stdout + done.stderr
    assert lines_of(done)[0].startswith('unit 3 answers in ') and lines_of(done)[0].endswith(' ms'), done.stdout
    assert lines_of(done)[1].endswith(': exception 2: it has no holding register 0'), done.stdout
    plant.close()


def test_what_the_command_takes():
    """Each wrong word is told, and opens nothing; what is right is used."""
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + '/board.io', 'w', encoding='utf-8') as out:
            out.write('BOARD "x"\nBUS yard peer interface=lo\n%QX0.0 sim safe=0\n')
        with open(folder + '/wrong.io', 'w', encoding='utf-8') as out:
            out.write('BOARD "x"\n%QX0.0 nonsense\n')
        with open(folder + '/empty.io', 'w', encoding='utf-8') as out:
            out.write('BOARD "x"\n%QX0.0 sim safe=0\n')
        no_option, needs = 'is no option here, or its value is wrong', 'is no option, or needs a value'
        for words, status, out, err in [
                ('--help', 0, 'usage: ladder-modbus', ''), ('--version', 0, 'ladder-modbus ', ''), ('scan --help', 0, 'usage: ', ''),
                ('--link', 2, '', f'--link {needs}'), ('--check', 2, '', f'--check {needs}'), ('--fly', 2, '', f'--fly {needs}'),
                ('--fly now', 2, '', f'--fly {no_option}'), ('--json', 2, '', f'--json {needs}'), ('--baud 9600', 2, '', f'--baud {no_option}'),
                ('scan', 2, '', 'scan needs the name of a bus and a map, or --port, or --host'),
                ('scan yard', 2, '', 'scan needs the name of a bus and a map'), ('scan yard --host 127.0.0.1', 2, '', 'scan needs the name of a bus'),
                ('scan yard board.io', 2, '', 'yard is no bus of this map'), ('scan yard empty.io', 2, '', 'yard is no bus of this map'),
                ('scan yard nothing.io', 1, '', 'nothing.io: error LD'), ('scan yard wrong.io', 1, '', 'wrong.io:2:8: error LD503'),
                ('scan yard board.io more', 2, '', f'more {needs}'), ('scan --link x', 2, '', f'--link {no_option}'),
                ('scan --check board.io', 2, '', f'--check {no_option}'), ('scan --port', 2, '', f'--port {needs}'),
                *[(f'scan --port /dev/none {it}', 2, '', f'{it.split(" ")[0]} {no_option}') for it in (
                    '--baud 0', '--baud 12345', '--baud 9600x', '--baud 5000000', '--baud ', '--parity mark', '--parity ', '--stop-bits 0',
                    '--stop-bits 3', '--stop-bits two', '--from -1', '--from 256', '--to 256', '--to x', '--timeout 0', '--timeout 60001', '--fly 1')],
                *[(f'scan --host {it}', 2, '', f'--host {no_option}') for it in ('', ':502', 'plc:', 'plc:0', 'plc:65536', 'plc:x', 'x' * 256)],
                ('scan --port /dev/none --from 5 --to 4', 2, '', '--from is above --to'),
                ('--check nothing.io', 1, '', 'nothing.io: error LD'), ('--check wrong.io', 1, '', 'wrong.io:2:8: error LD503'),
                ('--check empty.io', 0, 'empty.io: good', ''), ('--check board.io', 0, 'board.io: good', ''),
                ('scan --port /dev/none', 1, '', 'ladder-modbus: /dev/none: No such file or directory: is it the right serial line')]:
            done = run(*words.split(' '), cwd=folder)
            assert done.returncode == status and done.stdout.startswith(out) and err in done.stderr, (words, done)
            assert bool(done.stdout) == bool(out) and bool(done.stderr) == bool(err), (words, done)


def test_a_serial_line_is_scanned_as_it_is_set():
    """Speed, parity and stop bits reach the line. Nobody answers for 0, which is all units."""
    import termios
    wire = Wire()
    asked, seen = [], wire.answer
    serial = Units([2]).rtu(wire.theirs)
    for parity, stop, baud, wanted in [('even', 1, 9600, termios.PARENB), ('odd', 2, 1200, termios.PARENB | termios.PARODD | termios.CSTOPB),
                                       ('none', 2, 115200, termios.CSTOPB), ('none', 1, 19200, 0)]:
        def look(data):
            asked.append(termios.tcgetattr(wire.ends[0][1]))
            seen(data)
        wire.answer = look
        done = run('scan', '--port', wire.ours, '--baud', str(baud), '--parity', parity, '--stop-bits', str(stop), '--from', '0', '--to', '2',
                   '--timeout', '150')
        assert done.returncode == 0 and [line.split()[:3] for line in lines_of(done)] == [['unit', '2', 'answers']], done
        control, speed = asked[-1][2], asked[-1][4]
        # A pseudo-terminal has no parity: it keeps the rest.
        assert control & termios.CSTOPB == wanted & termios.CSTOPB and speed == getattr(termios, f'B{baud}'), (parity, stop, baud, control, speed)
    serial.close()
    wire.close()


def test_each_refusal_of_a_unit_has_its_words():
    """Exception N from unit N. 10 and 11 say that a unit behind a gateway is not there."""
    refuses = Stand(lambda frame: frame[:4] + b'\0\3' + frame[6:7] + b'\x83' + frame[6:7])
    done = run('scan', '--host', f'127.0.0.1:{refuses.port}', '--to', '12', '--timeout', '300')
    words = {1: 'it cannot read holding registers', 2: 'it has no holding register 0', 3: 'it does not take this request', 4: 'it has a failure',
             6: 'it is busy'}
    wanted = [f'unit {n}: exception {n}: {words.get(n, "it refuses")}' for n in range(1, 13) if n not in (10, 11)]
    assert [line.split(' answers')[0] + ': ' + line.split(': ', 1)[1] for line in lines_of(done)] == wanted and done.returncode == 0, done
    done = run('scan', '--host', f'127.0.0.1:{refuses.port}', '--to', '12', '--timeout', '300', '--json')
    assert [(it['unit'], it['exception']) for it in json.loads(done.stdout)['units']] == [(n, n) for n in range(1, 13) if n not in (10, 11)], done
    refuses.close()
    # An answer that fits the frame, but not the request; and several doubts in one object.
    senseless = Stand(lambda frame: frame[:4] + b'\0\7' + frame[6:7] + b'\3\4\0\0\0\0')
    done = run('scan', '--host', f'127.0.0.1:{senseless.port}', '--to', '2', '--timeout', '100')
    assert [line.split(':')[0] for line in lines_of(done)] == ['unit 1', 'unit 2'] and done.returncode == 1, done
    assert all('what it says is no answer to the request' in line for line in lines_of(done)), done
    done = run('scan', '--host', f'127.0.0.1:{senseless.port}', '--to', '2', '--timeout', '100', '--json')
    assert [it['at'] for it in json.loads(done.stdout)['doubts']] == [1, 2], done
    senseless.close()


def test_outputs_of_all_units_of_a_line():
    """What is sent to unit 0 has no answer. Each of its outputs has its turn, though the line is too slow for them, and so have the others."""
    wire = Wire()
    wire.ended = True
    wire.thread.join()
    board = f'''BOARD "on a table"
BUS rs485 modbus-rtu port={wire.ours} timeout=100ms
%QW0 modbus bus=rs485 unit=0 holding-register=7 safe=0 refresh=100ms
%QX10.0 modbus bus=rs485 unit=0 coil=3 safe=0 refresh=100ms
%QD20 modbus bus=rs485 unit=0 holding-register=20 as=REAL safe=0 refresh=100ms
%IW0 modbus bus=rs485 unit=2 input-register=0 poll=50ms stale=20s
%IX10.0 sim
%ID20 sim
'''
    frames, gone = [], threading.Event()

    def serve():
        """Unit 2 answers 5 for its register; each frame is kept."""
        data = b''
        while not gone.is_set():
            if not far.select.select([wire.ends[0][0]], [], [], 0.03)[0]:
                data = b''  # a frame ends with a silence
                continue
            data += os.read(wire.ends[0][0], 300)
            if len(data) > 4 and crc(data[:-2]) == data[-2:]:
                frames.append(data[:-2])
                if data[0] == 2:
                    answer = b'\2\4\2\0\5'
                    os.write(wire.ends[0][0], answer + crc(answer))
                data = b''

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    with Board(COPY, board) as it:
        wanted = [b'\0\6\0\7\0\5', b'\0\5\0\3\0\0', b'\0\x10\0\x14\0\2\4\0\0\0\0']
        assert until(lambda: all(frames.count(frame) > 2 for frame in wanted)), (frames[-20:], it.status())
        assert frames.count(b'\2\4\0\0\0\1') > 2 and 'rs485/2: answers' in it.status(), it.status()
    gone.set()
    thread.join()
    wire.close()


def test_a_second_gateway_waits_for_the_first():
    port = free_port()
    plant = Units([1]).tcp(port)
    board = f'''BOARD "on a table"
BUS plant modbus-tcp host=127.0.0.1:{port}
%IW0 modbus bus=plant unit=1 input-register=0 poll=5ms
%QW0 modbus bus=plant unit=1 holding-register=0 safe=0
'''
    with Board(COPY, board) as it:
        plant.set(1, 'input-register', 0, 1)
        assert until(lambda: plant.get(1, 'holding-register', 0) == 1), it.read('modbus.out')
        first = it.modbus
        it.start_modbus()
        assert until(lambda: 'does no other ladder-modbus run?' in it.read('modbus.out')), it.read('modbus.out')
        time.sleep(1.2)  # it asks again and again
        assert it.read('modbus.out').count('ladderd refuses') == 1, it.read('modbus.out')
        first.send_signal(signal.SIGTERM)
        assert first.wait(60) == 0
        plant.set(1, 'input-register', 0, 2)
        assert until(lambda: plant.get(1, 'holding-register', 0) == 2), it.read('modbus.out')
    plant.close()


class Stand:
    """Takes connections of TCP and does with each request what `answer(frame)` says: bytes, None for nothing, or 'end'."""

    def __init__(self, answer):
        self.answer, self.socket, self.requests = answer, socket.create_server(('127.0.0.1', 0)), 0
        self.port = self.socket.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        try:
            while True:
                threading.Thread(target=self.serve, args=(self.socket.accept()[0],), daemon=True).start()
        except OSError:
            pass

    def serve(self, peer):
        try:
            while frame := peer.recv(300):
                self.requests += 1
                said = self.answer(frame)
                if said == 'end':
                    break
                if said:
                    peer.sendall(said)
        except OSError:
            pass
        peer.close()

    def close(self):
        self.socket.close()


class Slow:
    """Takes one connection at a time, and refuses all for a while after each. What it does is as with Stand."""

    def __init__(self, answer):
        self.answer, self.listener = answer, socket.create_server(('127.0.0.1', 0))
        self.port, self.ended = self.listener.getsockname()[1], False
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        while not self.ended:
            peer = self.listener.accept()[0]
            self.listener.close()
            self.exchange(peer)
            peer.close()
            time.sleep(0.2)
            self.listener = socket.create_server(('127.0.0.1', self.port))
        self.listener.close()

    def exchange(self, peer):
        try:
            while frame := peer.recv(300):
                said = self.answer(frame)
                if said:
                    peer.sendall(said[0])
                    if said[1] == 'end':
                        return
        except OSError:
            pass

    def close(self):
        self.ended = True
        while self.thread.is_alive():
            with contextlib.suppress(OSError):
                socket.create_connection(('127.0.0.1', self.port)).close()
            time.sleep(0.02)


def test_a_scan_asks_each_unit_of_a_device_that_takes_connections_slowly():
    # It ends the connection after each answer, so that the next request meets an ended one.
    once = Slow(lambda frame: (frame[:4] + b'\0\5' + frame[6:7] + b'\3\2\0\0', 'end'))
    done = run('scan', '--host', f'127.0.0.1:{once.port}', '--to', '4', '--timeout', '1000')
    assert [line.split()[1] for line in lines_of(done)] == ['1', '2', '3', '4'], done.stdout + done.stderr
    once.close()
    # The scan connects anew after three units that are silent, before it asks the fourth one.
    last = Slow(lambda frame: (frame[:4] + b'\0\5' + frame[6:7] + b'\3\2\0\0', '') if frame[6] == 4 else None)
    done = run('scan', '--host', f'127.0.0.1:{last.port}', '--to', '5', '--timeout', '100')
    assert [line.split()[1] for line in lines_of(done)] == ['4'], done.stdout + done.stderr
    last.close()


def test_a_scan_of_a_port_that_refuses_or_hangs():
    nobody = free_port()
    done = run('scan', '--host', f'127.0.0.1:{nobody}', '--to', '5')
    assert done.returncode == 1 and not done.stdout, done.stdout
    assert done.stderr == f'ladder-modbus: 127.0.0.1:{nobody}: Connection refused: are address and port right, is the device on, and does it serve Modbus there?\n', done.stderr
    done = run('scan', '--host', 'no-such-host.invalid')
    assert done.returncode == 1 and done.stderr.startswith('ladder-modbus: no-such-host.invalid:502: '), done.stderr
    # A connection that nobody accepts: the queue of the listener is full.
    deaf, full = socket.socket(), []
    deaf.bind(('127.0.0.1', 0))
    deaf.listen(0)
    for _ in range(3):
        full.append(socket.socket())
        full[-1].setblocking(False)
        full[-1].connect_ex(deaf.getsockname())
    done = run('scan', '--host', '127.0.0.1:%d' % deaf.getsockname()[1], '--to', '5', '--timeout', '200')
    assert done.returncode == 1 and not done.stdout and 'are address and port right' in done.stderr, done.stderr
    for one in [deaf, *full]:
        one.close()
    # One that takes the connection and is silent, or speaks something else.
    silent = Stand(lambda frame: None)
    done = run('scan', '--host', f'127.0.0.1:{silent.port}', '--to', '4', '--timeout', '100')
    assert done.returncode == 1 and not done.stdout and silent.requests >= 4, done.stdout
    assert done.stderr == f'ladder-modbus: 127.0.0.1:{silent.port} takes the connection, but no unit answers: does it serve Modbus, and has it one of these numbers?\n', done.stderr
    done = run('scan', '--host', f'127.0.0.1:{silent.port}', '--to', '4', '--timeout', '100', '--json')
    assert done.returncode == 1 and json.loads(done.stdout) == {'units': [], 'doubts': []}, done.stdout
    silent.close()
    web = Stand(lambda frame: b'HTTP/1.1 400 Bad Request\r\n\r\n')
    done = run('scan', '--host', f'127.0.0.1:{web.port}', '--to', '2', '--timeout', '100')
    assert done.returncode == 1 and [line.split(':')[0] for line in lines_of(done)] == ['unit 1', 'unit 2'], done.stdout + done.stderr
    assert 'no answer of this unit' in done.stdout, done.stdout
    web.close()


def test_a_scan_with_answers_of_others():
    """An answer for another unit, or damaged, is told and does not count; one that ends the connection for numbers that it lacks is scanned whole."""
    wrong = Stand(lambda frame: frame[:4] + b'\0\5' + bytes([frame[6] % 247 + 1, 3, 2, 0, 0]))
    done = run('scan', '--host', f'127.0.0.1:{wrong.port}', '--to', '2', '--timeout', '100')
    assert done.returncode == 1 and len(lines_of(done)) == 2 and 'another unit answers for it' in lines_of(done)[0], done.stdout + done.stderr
    wrong.close()
    picky = Stand(lambda frame: frame[:4] + b'\0\5' + frame[6:7] + b'\3\2\0\0' if frame[6] in (2, 5) else 'end')
    done = run('scan', '--host', f'127.0.0.1:{picky.port}', '--to', '6', '--timeout', '100')
    assert done.returncode == 0 and [line.split()[1] for line in lines_of(done)] == ['2', '5'], done.stdout + done.stderr
    # It goes in the middle of the scan.
    gone = Stand(lambda frame: frame[:4] + b'\0\5' + frame[6:7] + b'\3\2\0\0' if frame[6] < 3 else (gone.close(), 'end')[1])
    done = run('scan', '--host', f'127.0.0.1:{gone.port}', '--to', '6', '--timeout', '100')
    assert done.returncode == 1 and len(lines_of(done)) == 2, done.stdout
    assert f'127.0.0.1:{gone.port}: gone at unit 3: ' in done.stderr, done.stderr
    picky.close()
    every = Stand(lambda frame: frame[:4] + b'\0\5' + frame[6:7] + b'\3\2\0\0')
    done = run('scan', '--host', f'127.0.0.1:{every.port}', '--to', '6')
    assert done.returncode == 0 and len(lines_of(done)) == 6 and 'answers for each number' in done.stderr, done.stderr
    every.close()
    wire = Wire()
    serial = Units([2, 4]).rtu(wire.theirs)
    wire.damage = lambda frame: [(0, frame[:-1] + bytes([frame[-1] ^ 1]) if frame[0] == 4 else frame)]
    done = run('scan', '--port', wire.ours, '--to', '5', '--timeout', '60')
    assert [line.split(' ')[1] for line in lines_of(done)] == ['2', '4:'] and 'the answer is damaged' in lines_of(done)[1], done.stdout
    done = run('scan', '--port', wire.ours, '--to', '5', '--timeout', '60', '--json')
    both = json.loads(done.stdout)
    assert [it['unit'] for it in both['units']] == [2] and [it['at'] for it in both['doubts']] == [4], done.stdout
    wire.down = True
    done = run('scan', '--port', wire.ours, '--to', '3', '--timeout', '40')
    assert done.returncode == 1 and done.stderr == f'ladder-modbus: {wire.ours}: no unit answers: are speed, parity and the two wires right, and is the device on?\n', done.stderr
    serial.close()
    wire.close()


def main():
    tests = [(name, test) for name, test in globals().items() if name.startswith('test_')]
    if len(sys.argv) > 1:
        tests = [(name, test) for name, test in tests if name in sys.argv[1:]]
    print(f'1..{len(tests)}', flush=True)
    failed = 0
    in_front()
    for number, (name, test) in enumerate(tests, 1):
        began = time.monotonic()
        begin_limit()
        try:
            test()
            print(f'ok {number} - {name[5:].replace("_", " ")}', flush=True)
        except Lacking as why:
            print(f'ok {number} - {name[5:].replace("_", " ")} # SKIP {why}', flush=True)
        except Exception:  # pylint: disable=broad-except
            failed += 1
            print(f'not ok {number} - {name[5:].replace("_", " ")}')
            print('# ' + traceback.format_exc().replace('\n', '\n# '), flush=True)
        if os.environ.get('TIMES'):
            print(f'# {time.monotonic() - began:.1f} s', flush=True)
    os._exit(failed != 0)


if __name__ == '__main__':
    main()
