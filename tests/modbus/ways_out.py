#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""ways_out - what each kind of output shows after each way out of RUN, for each kind of safe value, and that it is driven again.

    ways_out.py [WAY]

Cells: the ways below × the kinds of outputs × safe=0, safe=hold, safe=VALUE. Lines are those of a chip that ladderd and ladder-guard
share (guard_fake.c); pulse widths and converters are files in place of the kernel's; units of Modbus are the few lines
below, which take functions 5, 6, 15, 16 and answer no reads. WAYS_ROUNDS=N draws other values for N rounds; WAYS_SEED says which.
"""
import os
import random
import shutil
import signal
import socket
import struct
import sys
import threading
import time
import traceback
from collections import namedtuple

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)) + other for other in ('', '/../online')]
from board import BUILD, MODBUS, Board, until  # noqa: E402
from link import begin_limit  # noqa: E402

# ---- what is driven ----

Cell = namedtuple('Cell', 'kind choice name line type runs safe')
CHOICES = ('off', 'hold', 'value')
BITS, NUMBERS = (('BOOL', 1), ('INT', 5000))


def number(draw, most, *others):
    """A number that is far from the others."""
    while True:
        value = draw.randint(1, most)
        if all(abs(value - other) > 20 for other in others):
            return value


# A kind of output: where it is, and the line of the map of its n-th one. One address and one place for each choice of safe=.
KINDS = {
    'a line': (BITS, '%QX0.{n}', 'gpio line=OUT{n}'),
    'a line, active-low': (BITS, '%QX1.{n}', 'gpio line=OUT{m} active-low'),
    'a pulse width': (NUMBERS, '%AQW{w}', 'pwm chip=pwmchip0 channel={n} period=20ms range=0..10000 at 0%..100%'),
    'a converter': (NUMBERS, '%AQW1{w}', 'iio device=dac channel=voltage{n} range=0..10000 at 0V..10V'),
    'a coil': (BITS, '%QX20.{n}', 'modbus bus=plant unit=1 coil={n} refresh=50ms'),
    'a bit of a register': (BITS, '%QX21.{n}', 'modbus bus=plant unit=1 holding-register={n} bit=3 refresh=50ms'),
    'a register': (NUMBERS, '%QW4{w}', 'modbus bus=plant unit=1 holding-register=1{n} refresh=50ms'),
    'two registers': (('REAL', 5000), '%QD{d}', 'modbus bus=plant unit=1 holding-register=2{w} as=REAL refresh=50ms'),
    'a coil of a module': (BITS, '%XQX{w}.0', 'module bus=plant unit=1{n} type=Card refresh=50ms'),
    'a register of a module': (('INT', 1), '%XAQW{a}', ''),
}
LOCAL = [kind for kind in KINDS if not any(word in kind for word in ('coil', 'register'))]
LINES = [kind for kind in KINDS if kind.startswith('a line')]
GATEWAY = [kind for kind in KINDS if kind not in LOCAL]


def cells_of(draw, places=()):
    """All kinds × all choices. What an output shows in RUN is never its safe value. places: lines of the map of other devices."""
    cells = []
    for kind, ((type_, most), address, line) in KINDS.items():
        for n, choice in enumerate(CHOICES):
            if most == 1:
                safe = {'off': 0, 'hold': 'hold', 'value': 1}[choice]
                runs = int(safe != 1) if type_ == 'BOOL' else number(draw, 5000, 0)
            else:
                runs = number(draw, most, 0)
                safe = {'off': 0, 'hold': 'hold', 'value': number(draw, most, 0, runs)}[choice]
            at = {'n': n, 'm': n + 3, 'w': 2 * n, 'd': 60 + 4 * n, 'a': 16 * n}
            place = f'%XIB{3 * n}..{3 * n + 2}' if line.startswith('module') else address.format(**at)
            text = f'{place} {dict(places).get(kind, line).format(**at)} safe={safe}\n' if line else ''
            cells.append((kind, choice, f'O{len(cells)} AT {address.format(**at)} : {type_};', text, type_, runs, runs if safe == 'hold' else safe))
    return [Cell(*cell) for cell in cells]


def program(cells):
    text = 'RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  Loop AT %IX0.1 : BOOL;\n' + ''.join(f'  {cell.name}\n' for cell in cells) + 'END_VAR\n\nPROGRAM Main LD\n'
    for cell in cells:
        name = cell.name.split()[0]
        value = f'{cell.runs}.0' if cell.type == 'REAL' else cell.runs
        text += (f"RUNG\n  | {'NO' if cell.runs else 'NC'} SYS_ALWAYS_ON | COIL {name} |\n" if cell.type == 'BOOL' else
                 f'RUNG\n  | NO SYS_ALWAYS_ON | MOVE IN:={value} OUT=>{name} |\n')
    return text + 'RUNG\n  | NO Go | STOP |\nRUNG Again\n  | NO Loop | JMP Again |\nEND_PROGRAM\n'


class Units:
    """Registers and coils of units; it keeps each value that was written, and counts."""

    def __init__(self):
        self.values, self.seen, self.writes = {}, {}, 0
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
                answer = self.do(head[6], body)
                file.write(head[:4] + struct.pack('>HB', len(answer) + 1, head[6]) + answer)
                file.flush()

    def take(self, *at):
        *at, value = at
        self.values[tuple(at)] = value
        self.seen.setdefault(tuple(at), set()).add(value)

    def do(self, unit, body):
        function, first, count = struct.unpack('>BHH', body[:5])
        self.writes += function in (5, 6, 15, 16, 22)
        if function == 5:
            self.take(unit, 'coil', first, int(count == 0xff00))
        elif function == 6:
            self.take(unit, 'register', first, count)
        elif function == 15:
            for i in range(count):
                self.take(unit, 'coil', first + i, body[6 + i // 8] >> i % 8 & 1)
        elif function == 16:
            for i, value in enumerate(struct.unpack(f'>{count}H', body[6:])):
                self.take(unit, 'register', first + i, value)
        elif function == 22:
            self.take(unit, 'register', first, self.values.get((unit, 'register', first), 0) & count | struct.unpack('>H', body[5:7])[0] & ~count)
            return body[:7]
        else:
            return bytes([function | 0x80, 1])
        return body[:5]

    def is_quiet(self):
        """Nothing is written any more: longer than refresh= and a round of the bus."""
        before = self.writes
        time.sleep(0.4)
        return self.writes == before


# ---- the board ----

OUTS = 2 * len(CHOICES)     # lines of the chip, behind two inputs
SHARED = 56                 # bytes of each in the file that guard_fake.c shares


class Fakes:
    """Files in place of devices."""
    ladderd, guard = BUILD + '/tests/hal/guarded_ladderd', BUILD + '/tests/hal/guarded_guard'
    places = {}                 # of KINDS, if they are elsewhere
    near = {}                   # how exact a kind is
    lines_stay = True           # a line that nobody holds keeps its level

    def begin(self, folder):
        self.folder = folder
        self.show('class/pwm/pwmchip0/npwm', f'{len(CHOICES)}\n')
        self.show('class/pwm/pwmchip0/export', '')
        self.show('bus/iio/devices/iio:device0/name', 'dac\n')
        for n in range(len(CHOICES)):
            for name in ('period', 'duty_cycle', 'enable'):
                self.show(f'class/pwm/pwmchip0/pwm{n}/{name}', '0\n')
            self.show(f'bus/iio/devices/iio:device0/out_voltage{n}_raw', '0\n')
            self.show(f'bus/iio/devices/iio:device0/out_voltage{n}_scale', '1\n')
        os.mkdir(folder + '/dev')
        with open(folder + '/dev/gpiochip0', 'wb'), open(folder + '/lines', 'wb') as out:
            out.write(bytes(SHARED * (2 + OUTS) + 24))
        os.environ.update(FAKE_DEV=folder + '/dev', FAKE_SHARED=folder + '/lines', FAKE_SYS=folder + '/sys', FAKE_LINES=str(2 + OUTS))

    def show(self, name, text):
        path = f'{self.folder}/sys/{name}'
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='ascii') as out:
            out.write(text)

    def poke(self, at, value, form='<q'):
        with open(self.folder + '/lines', 'r+b') as file:
            file.seek(at)
            file.write(struct.pack(form, value))

    def input(self, line, level):
        self.poke(SHARED * line + 8, level, '<i')

    def fail(self):
        """Reads of lines fail."""
        self.poke(SHARED * (2 + OUTS), 1)

    def hang(self):
        """They wait."""
        self.poke(SHARED * (2 + OUTS), 2)

    def answer(self):
        self.poke(SHARED * (2 + OUTS), 0)

    def file(self, name):
        with open(f'{self.folder}/sys/{name}', encoding='ascii') as file:
            return int(file.read().split('\n', maxsplit=1)[0] or 0)

    def line(self, n):
        """The level of an output, and how often it has changed."""
        with open(self.folder + '/lines', 'rb') as file:
            file.seek(SHARED * (2 + n))
            _ns, level, _owner, _guard_ns, _guard_level, changes = struct.unpack('<qi20sqqq', file.read(SHARED))
        return level, changes

    def pulse(self, n):
        return self.file(f'class/pwm/pwmchip0/pwm{n}/duty_cycle') // 2000

    def converter(self, n):
        return self.file(f'bus/iio/devices/iio:device0/out_voltage{n}_raw')

    def end(self):
        pass


class Rig(Board):
    """ladder-guard, ladderd and ladder-modbus, and devices. Without a guard `ladderd` is itself."""

    def __init__(self, devices, cells, *options, guarded=True):
        self.devices, self.units, self.cells, self.guarded = devices, Units(), cells, guarded
        io = (f'BOARD "on a table"\nBUS plant modbus-tcp host=127.0.0.1:{self.units.port} timeout=200ms\n'
              'MODULE Card dq=1 aq=1 coil=0 holding-register=0\n%IX0.0 gpio line=IN0\n%IX0.1 gpio line=IN1\n')
        super().__init__(program(cells), io + ''.join(cell.line for cell in cells), *options)

    def put_ladderd(self):
        """A copy of its own: without it none begins again."""
        shutil.copy(self.devices.ladderd, self.folder + '/daemon')

    def start_ladderd(self):
        if not self.ladderd:
            self.devices.begin(self.folder)
            self.put_ladderd()
        words = ['./daemon', 'program.rung', '--io', 'board.io', '--link', 'link', '--groups', 'groups', '--period', '10ms', *self.options]
        if self.guarded:
            words = [self.devices.guard, '--name', 'ways-' + os.path.basename(self.folder), '--heartbeat', '1000', '--', *words]
        self.ladderd = self.spawn('ladderd', *words)

    def daemon(self):
        """The process of ladderd."""
        if not self.guarded:
            return self.ladderd.pid
        for pid in os.listdir('/proc'):
            if pid.isdigit():
                try:
                    with open(f'/proc/{pid}/stat', encoding='ascii', errors='replace') as file:
                        state, parent = file.read().rsplit(')', 1)[1].split()[:2]
                except OSError:
                    continue
                if int(parent) == self.ladderd.pid and state != 'Z':
                    return int(pid)
        return None

    def shows(self, cell):
        """What the output is at its device, in the numbers of the program."""
        n, at = CHOICES.index(cell.choice), self.units.values.get
        if cell.kind == 'a line':
            return self.devices.line(n)[0]
        if cell.kind == 'a line, active-low':
            return 1 - self.devices.line(n + len(CHOICES))[0]
        if cell.kind == 'a pulse width':
            return self.devices.pulse(n)
        if cell.kind == 'a converter':
            return self.devices.converter(n)
        if cell.kind == 'a coil':
            return at((1, 'coil', n), -1)
        if cell.kind == 'a bit of a register':
            return at((1, 'register', n), 0) >> 3 & 1
        if cell.kind == 'a register':
            return at((1, 'register', 10 + n), -1)
        if cell.kind == 'two registers':
            both = [at((1, 'register', 20 + 2 * n + i), 0) for i in range(2)]
            return struct.unpack('>f', struct.pack('>HH', *both))[0]
        return at((10 + n, 'coil' if cell.kind == 'a coil of a module' else 'register', 0), -1)

    def differ(self, wanted):
        """Cells that do not show it: none is good."""
        return [f'{cell.kind}, {cell.choice}: {self.shows(cell)} and not {wanted(cell)}' for cell in self.cells
                if abs(self.shows(cell) - wanted(cell)) > self.devices.near.get(cell.kind, 0)]

    def __exit__(self, kind, *error):
        self.devices.answer()
        for process in (self.ladderd, self.modbus):
            process.send_signal(signal.SIGCONT)
        super().__exit__(kind, *error)
        self.units.socket.close()
        self.devices.end()


# ---- ways out of RUN ----

def stop_by_program(it):
    it.devices.input(0, 1)


def run_after_stop(it):
    it.devices.input(0, 0)
    it.ladderd.send_signal(signal.SIGHUP)


def stop_by_desk(it):
    it.command('stop')


def run_by_desk(it):
    it.command('run')


def loop(it):
    it.devices.input(1, 1)


def end_loop(it):
    it.devices.input(1, 0)
    it.ladderd.send_signal(signal.SIGHUP)


def hang(it):
    it.devices.hang()


def fail(it):
    it.devices.fail()


def answer_again(it):
    """A scan must have read the lines before the reset counts."""
    it.devices.answer()
    assert until(lambda: not it.ladderd.send_signal(signal.SIGHUP) and (time.sleep(0.05) or not it.differ(lambda cell: cell.runs)))


def to_all(number_):
    def act(it):
        it.ladderd.send_signal(number_)
        it.ladderd.wait(60)
    return act


def to_ladderd(number_):
    """No other one begins until again() has put it back."""
    def act(it):
        pid = it.daemon()
        os.remove(it.folder + '/daemon')
        os.kill(pid, number_)
    return act


def again(it):
    if it.ladderd.poll() is None and it.guarded:
        it.ladderd.send_signal(signal.SIGTERM)
    it.ladderd.wait(60)
    it.put_ladderd()
    it.start_ladderd()


def kill_gateway(it):
    it.modbus.kill()
    it.modbus.wait(60)


def freeze_gateway(it):
    it.modbus.send_signal(signal.SIGSTOP)


def thaw_gateway(it):
    it.modbus.send_signal(signal.SIGCONT)


def start_gateway(it):
    it.start_modbus()


def cut(it):
    it.units.is_cut = True


def join(it):
    it.units.is_cut = False


SAFE, RUNS, FREE = 'safe', 'runs', 'not controlled'
# ends: nobody holds the lines then, or the chip is gone.
Way = namedtuple('Way', 'act back lines words gateway refreshed guarded options state ends', defaults=(True, (), None, False))
WAYS = {
    'STOP by the program': Way(stop_by_program, run_after_stop, SAFE, SAFE, SAFE, True, state='STOP'),
    'STOP by a desk': Way(stop_by_desk, run_by_desk, SAFE, SAFE, SAFE, True, state='STOP'),
    'a fault of the program': Way(loop, end_loop, SAFE, SAFE, SAFE, True, options=('--watchdog', '1000'), state='FAULT'),
    'the watchdog of scans': Way(hang, answer_again, SAFE, SAFE, SAFE, True),
    'a line does not answer': Way(fail, answer_again, SAFE, SAFE, SAFE, True, state='FAULT', ends=True),
    'SIGTERM': Way(to_all(signal.SIGTERM), again, SAFE, SAFE, SAFE, False, ends=True),
    'SIGINT without a guard': Way(to_all(signal.SIGINT), again, SAFE, SAFE, SAFE, False, guarded=False, ends=True),
    'a crash under ladder-guard': Way(to_ladderd(signal.SIGSEGV), again, SAFE, SAFE, SAFE, False),
    'a crash without a guard': Way(to_ladderd(signal.SIGABRT), again, SAFE, SAFE, SAFE, False, guarded=False, ends=True),
    'SIGKILL under ladder-guard': Way(to_ladderd(signal.SIGKILL), again, SAFE, SAFE, SAFE, False),
    'ladderd stands still under ladder-guard': Way(to_ladderd(signal.SIGSTOP), again, SAFE, SAFE, SAFE, False),
    'SIGKILL without a guard': Way(to_ladderd(signal.SIGKILL), again, FREE, RUNS, SAFE, False, guarded=False),
    'SIGKILL to ladder-modbus': Way(kill_gateway, start_gateway, RUNS, RUNS, RUNS, False),
    'ladder-modbus stands still': Way(freeze_gateway, thaw_gateway, RUNS, RUNS, RUNS, False),
    'the network is cut': Way(cut, join, RUNS, RUNS, RUNS, False),
}


def wanted_after(way, cell):
    is_ = way.lines if cell.kind in LINES else way.words if cell.kind in LOCAL else way.gateway
    return cell.safe if is_ == SAFE else cell.runs


def way_out(way, draw, devices):
    cells = cells_of(draw, devices.places)
    free = way.lines == FREE or way.ends and not devices.lines_stay
    with Rig(devices, cells, *way.options, guarded=way.guarded) as it:
        its = [cell for cell in cells if not free or cell.kind not in LINES]
        assert until(lambda: not it.differ(lambda cell: cell.runs)), (it.differ(lambda cell: cell.runs), it.command('status'))
        changes = [devices.line(n)[1] for n in range(OUTS)]
        it.cells = its
        way.act(it)
        assert until(lambda: not it.differ(lambda cell: wanted_after(way, cell))), it.differ(lambda cell: wanted_after(way, cell))
        assert until(lambda: it.units.is_quiet() != way.refreshed), 'refreshed' if not way.refreshed else 'not refreshed'
        assert not it.differ(lambda cell: wanted_after(way, cell)), it.differ(lambda cell: wanted_after(way, cell))
        if way.state:
            assert until(lambda: f'mode: {way.state}' in it.command('status')), it.command('status')
        # What holds its level has not changed it, not even for a moment.
        hold = CHOICES.index('hold')
        for n in () if free else (hold, hold + len(CHOICES)):
            assert devices.line(n)[1] == changes[n], 'a line that holds has changed'
        # A device was never told another value than these two.
        for cell in cells:
            n = CHOICES.index(cell.choice)
            at = {'a coil': (1, 'coil', n), 'a register': (1, 'register', 10 + n), 'a coil of a module': (10 + n, 'coil', 0),
                  'a register of a module': (10 + n, 'register', 0)}.get(cell.kind)
            assert not at or it.units.seen[at] <= {cell.runs, cell.safe}, (cell.kind, cell.choice, it.units.seen[at])
        way.back(it)
        it.cells = cells
        assert until(lambda: not it.differ(lambda cell: cell.runs)), ('it is not driven again', it.differ(lambda cell: cell.runs))
    return len(its)


def main():
    if not os.path.exists(MODBUS):
        print('1..0 # SKIP built without ladder-modbus')
        return 0
    return run(Fakes(), sys.argv[1:] or WAYS)


def run(devices, names):
    seed, rounds = int(os.environ.get('WAYS_SEED', '1')), int(os.environ.get('WAYS_ROUNDS', '1'))
    ways = {name: way for name, way in WAYS.items() if name in names}
    print(f'1..{rounds * len(ways) + 1}', flush=True)
    failed = count = number_ = 0
    for round_ in range(rounds):
        draw = random.Random(seed + round_)
        for name, way in ways.items():
            number_ += 1
            begin_limit()
            try:
                cells = way_out(way, draw, devices)
                count += cells
                print(f'ok {number_} - {name}: {cells} outputs', flush=True)
            except Exception as error:  # pylint: disable=broad-except
                failed = 1
                print(f'not ok {number_} - {name}, WAYS_SEED={seed + round_}\n# {error!r}')
                print(''.join('# ' + line + '\n' for line in traceback.format_exc().splitlines()), flush=True)
    print(f'{"not " if failed else ""}ok {number_ + 1} - {count} cells of ways out × kinds of outputs × safe values')
    return failed


if __name__ == '__main__':
    sys.exit(main())
