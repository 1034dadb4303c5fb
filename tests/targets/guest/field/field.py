#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""field - in a guest: analog values, pulse widths and chips by the drivers of its kernel, and a plant with two boards.

    field.py BUILD KILLS [TEST]

Converters are the dummy of Industrial I/O, and chips whose registers are memory (i2c-stub): a test writes what a chip would
measure, and reads what it would drive. Chips of chips-sim.c and w1-sim.c are on simulated buses. Lines are those of gpio-sim. Units of Modbus are those of pymodbus. Times are the guest's.
"""
import ctypes
import fcntl
import glob
import os
import random
import signal
import subprocess
import sys
import time
import traceback

BUILD, KILLS = sys.argv[1], int(sys.argv[2])
os.environ['BUILD'] = BUILD
TOP = os.getcwd()
sys.path[:0] = [TOP + '/tests/modbus', TOP + '/tests/online']
import board  # noqa: E402
import client  # noqa: E402
import plant  # noqa: E402
import ways_out  # noqa: E402
from board import until  # noqa: E402
from far import Units  # noqa: E402
from plant import Machine, near, tell  # noqa: E402

CONFIG = '/sys/kernel/config'
BUS = '/sys/bus/i2c/devices/i2c-0'


def put(path, text):
    with open(path, 'w', encoding='ascii') as out:
        out.write(str(text))


def get(path):
    with open(path, encoding='ascii') as file:
        return file.read().strip()


class Lines:
    """A chip of gpio-sim."""

    def __init__(self, label, names):
        self.home, self.names = f'{CONFIG}/gpio-sim/{label}', list(names)
        os.makedirs(self.home + '/bank')
        put(self.home + '/bank/num_lines', len(self.names))
        put(self.home + '/bank/label', label)
        for i, name in enumerate(self.names):
            os.mkdir(f'{self.home}/bank/line{i}')
            put(f'{self.home}/bank/line{i}/name', name)
        put(self.home + '/live', 1)
        self.sys = f"/sys/devices/platform/{get(self.home + '/dev_name')}/{get(self.home + '/bank/chip_name')}"

    def value(self, name):
        return int(get(f'{self.sys}/sim_gpio{self.names.index(name)}/value'))

    def pull(self, name, level):
        put(f'{self.sys}/sim_gpio{self.names.index(name)}/pull', 'pull-up' if level else 'pull-down')

    def close(self):
        put(self.home + '/live', 0)
        for i in range(len(self.names)):
            os.rmdir(f'{self.home}/bank/line{i}')
        os.rmdir(self.home + '/bank')
        os.rmdir(self.home)


class Converter:
    """A dummy of Industrial I/O: its input 0 in volts, its output 0 in volts."""

    def __init__(self, name):
        self.name = name
        self.begin()

    def begin(self):
        os.mkdir(f'{CONFIG}/iio/devices/dummy/{self.name}')
        self.sys = next(it for it in glob.glob('/sys/bus/iio/devices/iio:device*') if get(it + '/name') == self.name)

    def measure(self, volts):
        scale, offset = (float(get(f'{self.sys}/in_voltage0_{it}')) for it in ('scale', 'offset'))
        put(self.sys + '/in_voltage0_raw', round(volts * 1000 / scale - offset))

    def output(self):
        return int(get(self.sys + '/out_voltage0_raw')) / 1000

    def close(self):
        os.rmdir(f'{CONFIG}/iio/devices/dummy/{self.name}')


class Chip:
    """A chip on the bus that is memory."""

    def __init__(self, driver, address):
        self.address, self.fd = address, os.open('/dev/i2c-0', os.O_RDWR)
        fcntl.ioctl(self.fd, 0x0706, address)
        self.driver = driver

    def there(self):
        put(BUS + '/new_device', f'{self.driver} {self.address:#x}')
        return self

    def access(self, write, register, size, value=0):
        data = (ctypes.c_uint8 * 34)(value & 255, value >> 8 & 255)

        class Request(ctypes.Structure):
            _fields_ = [('write', ctypes.c_uint8), ('register', ctypes.c_uint8), ('size', ctypes.c_uint32), ('data', ctypes.c_void_p)]

        request = Request(0 if write else 1, register, size, ctypes.addressof(data))
        fcntl.ioctl(self.fd, 0x0720, bytearray(request))
        return data[0] | data[1] << 8

    def byte(self, register):
        return self.access(False, register, 2) & 255

    def word(self, register):
        return self.access(False, register, 3)

    def set_word(self, register, value):
        """With the higher byte first."""
        self.access(True, register, 3, (value & 255) << 8 | value >> 8 & 255)

    def close(self):
        put(BUS + '/delete_device', f'{self.address:#x}')
        os.close(self.fd)


class Bus:
    """A bus of chips-sim.c or w1-sim.c: parameters of a module are the other side of its chips."""

    def __init__(self, module, number=None):
        self.sys, self.bus = f'/sys/module/{module}/parameters/', f'/sys/bus/i2c/devices/i2c-{number}'

    def there(self, driver, address):
        put(self.bus + '/new_device', f'{driver} {address:#x}')

    def gone(self, address):
        put(self.bus + '/delete_device', f'{address:#x}')

    def set(self, **values):
        for name, value in values.items():
            put(self.sys + name, value)

    def get(self, name):
        return int(get(self.sys + name), 0)


def pulse(chip, channel):
    """What a PCA9685 gives at a pin: the part of a period, from 0 to 1."""
    on_low, on_high, off_low, off_high = (chip.byte(6 + 4 * channel + i) for i in range(4))
    if off_high & 0x10:
        return 0
    if on_high & 0x10:
        return 1
    return ((off_low | (off_high & 15) << 8) - (on_low | (on_high & 15) << 8)) % 4096 / 4096


# ---- converters and pulse widths ----

ANALOG = '''RUNGBOARD 1

VAR
  Level  AT %AIW0  : INT;
  Good   AT %IX200.0 : BOOL;
  Valve  AT %AQW0  : INT;
  Full   AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main ST
  Valve := Level / 2;
  Full := Level > 20000;
END_PROGRAM
'''
ANALOG_IO = '''BOARD "a converter"
%AIW0    iio      device=tank channel=voltage0 range=0..27648 at 0V..10V poll=20ms stale=200ms substitute=-1
%IX200.0 quality  of=%AIW0
%AQW0    iio      device=valve channel=voltage0 range=0..27648 at 0V..10V safe=2765
%QX0.0   sim      safe=0
'''


def test_a_converter_of_the_kernel():
    """A voltage comes in, another goes out; the safe value; a converter that goes and comes back."""
    tank, valve = Converter('tank'), Converter('valve')
    with Machine(ANALOG, ANALOG_IO, '--period', '5ms') as it:
        for volts in (0, 5, 10, 2.5):
            tank.measure(volts)
            assert until(lambda: near(it.read1('Level'), 2764.8 * volts, 1)), it.read1('Level')
            assert until(lambda: near(valve.output(), volts / 2, 0.002)), valve.output()
        assert it.read1('Good') is True
        it.command('stop')
        assert until(lambda: near(valve.output(), 1.0, 0.002)), valve.output()
        it.command('run')
        assert until(lambda: near(valve.output(), 1.25, 0.002)), valve.output()
        tank.close()
        began = time.monotonic()
        assert until(lambda: it.read1('Level') == -1 and it.read1('Good') is False)
        tell(f'a converter that has gone is noticed after {(time.monotonic() - began) * 1000:.0f} ms')
        tank.begin()
        tank.measure(7.5)
        assert until(lambda: near(it.read1('Level'), 20736, 1) and it.read1('Good') is True), (it.read1('Level'), it.read('ladderd.out'))
        it.ladderd.send_signal(signal.SIGTERM)
        assert it.ladderd.wait(60) == 0 and near(valve.output(), 1.0, 0.002), valve.output()
    tank.close()
    valve.close()


CHIPS = '''RUNGBOARD 1

VAR
  Volts  AT %AIW0  : INT;
  Degree AT %AIW2  : INT;
  Dim    AT %AQW0  : INT;
  Wide   AT %AQW2  : INT;
  Key    AT %IX0.0 : BOOL;
  Lamp   AT %QX0.0 : BOOL;
  Hot    AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main ST
  Dim := Volts;
  Wide := 27648 - Volts;
  Lamp := Key;
  Hot := Degree > 3000;
END_PROGRAM
'''
CHIPS_IO = '''BOARD "chips on I2C"
%AIW0  iio    device=ads1015 channel=voltage0 range=0..27648 at 0V..2V poll=20ms
%AIW2  hwmon  device=lm75 channel=temp1 poll=20ms
%AQW0  pwm    chip=pca9685-pwm channel=0 period=20ms safe=0
%AQW2  pwm    chip=pca9685-pwm channel=7 period=20ms safe=13824
%IX0.0 gpio   chip=mcp23017 offset=8
%QX0.0 gpio   chip=mcp23017 offset=0 safe=0
%QX0.1 gpio   chip=mcp23017 offset=1 safe=1
'''


def test_chips_on_i2c():
    """ADS1015, LM75, PCA9685 and MCP23017 by the drivers of the kernel, by the names that docs/field.md gives."""
    adc, sensor = Chip('ads1015', 0x48).there(), Chip('lm75', 0x4f)
    sensor.set_word(0, 0x1900)
    sensor.there()
    lamp, port = Chip('pca9685', 0x40).there(), Chip('mcp23017', 0x20).there()
    with Machine(CHIPS, CHIPS_IO, '--period', '20ms') as it:
        for volts in (0.5, 1.0, 1.75, 0.0):
            adc.set_word(0, round(volts * 1000) << 4)
            wide = volts / 2
            assert until(lambda: near(it.read1('Volts'), 27648 * wide, 16)), it.read1('Volts')
            assert until(lambda: near(pulse(lamp, 0), wide, 0.001) and near(pulse(lamp, 7), 1 - wide, 0.001)), (pulse(lamp, 0), pulse(lamp, 7))
        for value, hot in ((0x1900, 0), (0x2800, 1), (0x1e00, 0)):
            sensor.set_word(0, value)
            assert until(lambda: near(it.read1('Degree'), value / 256 * 100, 50) and port.word(0x14) >> 1 & 1 == hot), it.read1('Degree')
        for level in (1, 0, 1):
            port.access(True, 0x12, 3, level << 8)
            assert until(lambda: port.word(0x14) & 1 == level), port.word(0x14)
        adc.set_word(0, 1500 << 4)
        assert until(lambda: near(pulse(lamp, 0), 0.75, 0.001))
        it.command('stop')
        assert until(lambda: pulse(lamp, 0) == 0 and near(pulse(lamp, 7), 0.5, 0.001) and port.word(0x14) & 3 == 2), (pulse(lamp, 0), port.word(0x14))
        it.command('run')
        assert until(lambda: near(pulse(lamp, 0), 0.75, 0.001))
    assert pulse(lamp, 0) == 0 and near(pulse(lamp, 7), 0.5, 0.001) and port.word(0x14) & 3 == 2
    for chip in (adc, sensor, lamp, port):
        chip.close()


SHIPPED = '''RUNGBOARD 1

VAR
  Volts     AT %AIW0    : INT;
  Last      AT %AIW6    : INT;
  Loop      AT %AIW8    : INT;
  Other     AT %AIW10   : INT;
  Contact   AT %IX10.0  : BOOL;
  Pipe      AT %AIW20   : INT;
  Room      AT %AIW22   : INT;
  VoltsGood AT %IX200.0 : BOOL;
  LoopGood  AT %IX200.1 : BOOL;
  PipeGood  AT %IX200.2 : BOOL;
  RoomGood  AT %IX200.3 : BOOL;
  Dac       AT %AQW0    : INT;
  Fan       AT %AQW2    : INT;
  Heat      AT %AQW4    : INT;
  Key       AT %IX20.0  : BOOL;
  Lamp      AT %QX20.0  : BOOL;
  Key2      AT %IX21.0  : BOOL;
  Lamp2     AT %QX21.0  : BOOL;
  Wanted    AT %MW0     : INT := 13824;
END_VAR

PROGRAM Main ST
  Dac := Wanted;
  Fan := Volts;
  Heat := 27648 - Volts;
  Lamp := Key;
  Lamp2 := Key2;
END_PROGRAM
'''
QUALITIES = '%IX200.0 quality of=%AIW0\n%IX200.1 quality of=%AIW8\n%IX200.2 quality of=%AIW20\n%IX200.3 quality of=%AIW22\n'
LAMP, LAMP2 = 0x100, 0x10  # of the MCP23017, and of the PCF8574, where a lamp is on when its line is low


def test_the_map_with_converters_and_expanders():
    """ladders/boards/raspberry-pi-analog.io as it is, but for the processor's own sensor: each chip works, fails, and is back."""
    with open('ladders/boards/raspberry-pi-analog.io', encoding='utf-8') as file:
        text = file.read()
    assert text.count('device=cpu_thermal') == 1
    text = text.replace('device=cpu_thermal', 'device=tmp102') + QUALITIES
    chips, wire, pwm = Bus('chips_sim', 7), Bus('w1_sim'), Chip('pca9685', 0x40).there()
    chips.set(ads1115_mv='500,0,0,2000', mcp3008_step='558,512,0,0,0,0,0,0', tmp102_mc=31250, away=0, spi_away='N')
    wire.set(temperature=21437, away='N')
    there = {0x20: 'mcp23017', 0x24: 'pcf8574', 0x48: 'ads1115', 0x49: 'tmp102', 0x60: 'mcp4725'}
    for address, driver in there.items():
        chips.there(driver, address)

    def reads(name, value, by=0):
        assert until(lambda: near(it.read1(name), value, by)), (name, it.read1(name), value)

    def dac(value):
        assert until(lambda: near(chips.get('mcp4725_step'), value * 4096 / 27648, 1)), chips.get('mcp4725_step')

    def lamps(lamp, lamp2):
        """Also the levels at the pins of the other chip."""
        assert until(lambda: (chips.get('mcp23017_pins') & LAMP, chips.get('pcf8574_pins') & LAMP2) == (LAMP * lamp, LAMP2 * (not lamp2))), (
            chips.get('mcp23017_pins'), chips.get('pcf8574_pins'))

    def is_safe():
        dac(0)
        assert until(lambda: pulse(pwm, 0) == 0 and pulse(pwm, 1) == 0), (pulse(pwm, 0), pulse(pwm, 1))

    with Machine(SHIPPED, text, '--period', '20ms') as it:
        # All inputs, in the units of the map: 4 V, 0.6 to 3 V, 3.3 V, hundredths of a degree.
        for name, value, by in (('Volts', 3456, 4), ('Last', 13824, 4), ('Loop', 13824, 40), ('Other', 13824, 30), ('Contact', 0, 0), ('Pipe', 2138, 1), ('Room', 3125, 0)):
            reads(name, value, by)
        chips.set(ads1115_mv='1000,0,0,100', mcp3008_step='186,1023,700,0,0,0,0,0', tmp102_mc=-25500)
        wire.set(temperature=-10125)
        for name, value, by in (('Volts', 6912, 4), ('Last', 691, 4), ('Loop', 0, 40), ('Other', 27648, 30), ('Contact', 1, 0), ('Pipe', -1012, 1), ('Room', -2550, 0)):
            reads(name, value, by)
        for name in ('VoltsGood', 'LoopGood', 'PipeGood', 'RoomGood'):
            reads(name, True)
        # All outputs.
        dac(13824)
        assert until(lambda: near(pulse(pwm, 0), 0.25, 0.002) and near(pulse(pwm, 1), 0.75, 0.002)), (pulse(pwm, 0), pulse(pwm, 1))
        for key, key2 in ((1, 0), (0, 1), (1, 1), (0, 0)):
            chips.set(mcp23017_outside=key, pcf8574_outside=0xff - key2)
            lamps(key, key2)
        # A converter or a sensor that does not answer: the value is not good, and the program runs on.
        for name, value, by, set_again in (('Volts', 6912, 4, lambda: chips.set(away=0x48, ads1115_mv='0,0,0,0')),
                                           ('Room', -2550, 0, lambda: chips.set(away=0x49, tmp102_mc=0)),
                                           ('Pipe', -1012, 1, lambda: wire.set(away='Y', temperature=0))):
            set_again()
            reads(name + 'Good', False)
            reads(name, value, by)
            chips.set(away=0)
            wire.set(away='N')
            reads(name + 'Good', True)
            reads(name, 0, by)
        # Nobody hears that a chip of SPI has gone; the limits of the current loop find what its open wire measures.
        chips.set(spi_away='Y')
        reads('LoopGood', False)
        reads('Loop', 0)
        reads('Other', 27648, 30)
        chips.set(spi_away='N')
        reads('LoopGood', True)
        # An output that does not answer, also one whose driver has gone: it gets the value of now when it is back.
        chips.set(away=0x60)
        it.set(Wanted=20736)
        assert until(lambda: 'fault' in it.command('get', 'Dac')), it.command('get', 'Dac')
        assert near(chips.get('mcp4725_step'), 2048, 1)
        chips.set(away=0)
        dac(20736)
        chips.gone(0x60)
        it.set(Wanted=6912)
        assert until(lambda: 'fault' in it.command('get', 'Dac')), it.command('get', 'Dac')
        chips.there('mcp4725', 0x60)
        dac(6912)
        status = it.desk.status()
        assert status['mode'] == client.RUN, status
        # A line that does not answer is a FAULT: all outputs that can be reached are safe.
        chips.set(mcp23017_outside=1, pcf8574_outside=0xfe)
        lamps(1, 1)
        for address, safe in ((0x24, ('mcp23017_pins', LAMP, 0)), (0x20, ('pcf8574_pins', LAMP2, LAMP2))):
            name, mask, level = safe
            chips.set(away=address)
            assert until(lambda: it.desk.status()['mode'] == client.FAULT), it.command('status')
            is_safe()
            assert until(lambda: chips.get(name) & mask == level), chips.get(name)
            chips.set(away=0)
            # The driver of the MCP23017 takes what it could not write for written (docs/field.md).
            time.sleep(2)
            lamps(address == 0x20, 0)
            assert until(lambda: 'error' not in it.command('reset') and it.desk.status()['mode'] != client.FAULT), it.command('status')
            lamps(1, 1)
            dac(13824)
        it.command('stop')
        is_safe()
        lamps(0, 0)
        it.command('run')
        lamps(1, 1)
        dac(13824)
        tell(f"the MCP23017 has {chips.get('mcp23017_pull_up'):#x} in its register of pull-ups")
    is_safe()
    lamps(0, 0)
    for address in there:
        chips.gone(address)
    pwm.close()


# ---- a gateway that is killed ----

REMOTE = '''RUNGBOARD 1

VAR
  Enable AT %IX10.0 : BOOL;
  Wish   AT %IW12   : INT;
  Pump   AT %QX0.0  : BOOL;
  Speed  AT %AQW0   : INT;
  Valve  AT %AQW2   : INT;
  Told   AT %QW20   : INT;
END_VAR

PROGRAM Main ST
  Pump := Enable;
  Speed := SEL(Enable, 0, Wish);
  Valve := SEL(Enable, 0, Wish);
  Told := Wish;
END_PROGRAM
'''


def test_a_gateway_is_killed_and_outputs_are_safe():
    """What the program drives by values of a bus goes off, at a line, a converter and a pulse width; no scan is missed."""
    lines, valve, lamp = Lines('pumps', ['PUMP', 'SPARE']), Converter('valve'), Chip('pca9685', 0x40).there()
    port = board.free_port()
    units = Units([1]).tcp(port)
    units.set(1, 'discrete-input', 0, 1)
    units.set(1, 'input-register', 0, 13824)
    io = f'''BOARD "a pump"
BUS plant modbus-tcp host=127.0.0.1:{port} timeout=300ms
%IX10.0 modbus bus=plant unit=1 discrete-input=0 poll=20ms stale=200ms substitute=0
%IW12 modbus bus=plant unit=1 input-register=0 poll=20ms stale=200ms substitute=0
%QX0.0 gpio line=PUMP safe=0
%AQW0 pwm chip=pca9685-pwm channel=0 period=20ms safe=0
%AQW2 iio device=valve channel=voltage0 range=0..27648 at 0V..10V safe=0
%QW20 modbus bus=plant unit=1 holding-register=0 safe=0 refresh=100ms
'''

    def runs():
        return lines.value('PUMP') == 1 and near(pulse(lamp, 0), 0.5, 0.001) and near(valve.output(), 5, 0.002)

    def is_off():
        return lines.value('PUMP') == 0 and pulse(lamp, 0) == 0 and valve.output() == 0

    took, back = [], []
    with Machine(REMOTE, io, '--period', '10ms', gateway=True) as it:
        assert until(runs), it.command('status')
        for _ in range(KILLS):
            it.modbus.kill()
            began = time.monotonic()
            assert until(is_off), it.command('status')
            took.append(time.monotonic() - began)
            it.modbus.wait(60)
            it.start_modbus()
            began = time.monotonic()
            assert until(runs), it.command('status')
            back.append(time.monotonic() - began)
        status = it.desk.status()
        assert status['mode'] == client.RUN and status['missed'] == 0, status
        assert max(took) < 0.3 and max(back) < 2, (max(took), max(back))
        tell(f"{KILLS} gateways were killed: outputs off after {max(took) * 1000:.0f} ms at most, on again after {max(back) * 1000:.0f} ms "
             f"at most; {status['missed']} of {status['scans']} scans missed")
        # The unit is gone, then comes back; and last the board itself ends.
        units.stop()
        assert until(is_off)
        units.tcp(port)
        assert until(runs), it.command('status')
        it.ladderd.send_signal(signal.SIGTERM)
        it.ladderd.wait(60)
        assert is_off()
    units.close()
    for thing in (lines, valve, lamp):
        thing.close()


# ---- each way out of RUN ----

class Ways(ways_out.Fakes):
    """Lines of gpio-sim, pulse widths of a chip, converters."""
    ladderd, guard = BUILD + '/ladderd', BUILD + '/ladder-guard'
    places = {'a pulse width': 'pwm chip=pca9685-pwm channel={n} period=20ms range=0..10000 at 0%..100%',
              'a converter': 'iio device=dac{n} channel=voltage0 range=0..10000 at 0V..10V'}
    near = {'a pulse width': 4, 'a converter': 1}
    lines_stay = False
    ways = [name for name in ways_out.WAYS if name != 'the watchdog of scans']  # it needs a driver that hangs

    def begin(self, folder):
        self.chip = Chip('pca9685', 0x40).there()
        self.dacs = [Converter(f'dac{n}') for n in range(len(ways_out.CHOICES))]
        self.lines = None
        self.answer()

    def answer(self):
        if not self.lines:
            self.lines = Lines('ways', ['IN0', 'IN1'] + [f'OUT{n}' for n in range(ways_out.OUTS)])

    def fail(self):
        """The chip is unplugged."""
        self.lines.close()
        self.lines = None

    def input(self, line, level):
        self.lines.pull(f'IN{line}', level)

    def line(self, n):
        return self.lines.value(f'OUT{n}'), 0

    def pulse(self, n):
        return round(pulse(self.chip, n) * 10000)

    def converter(self, n):
        return round(self.dacs[n].output() * 1000)

    def end(self):
        for thing in (self.lines, self.chip, *self.dacs):
            thing.close()


def test_each_way_out_of_run():
    """Lines, pulse widths, converters and units of Modbus have their safe values; see ways_out.py."""
    cells = 0
    for name in Ways.ways:
        try:
            cells += ways_out.way_out(ways_out.WAYS[name], random.Random(1), Ways())
        except Exception as error:
            raise AssertionError(name) from error
    tell(f'{len(Ways.ways)} ways out, {cells} outputs')


# ---- the cement plant on two boards ----

MACHINES_GPIO = ''.join(f'%IX0.{n} gpio line=WIRE{n}\n' for n in range(7))


class Kernel:
    """The console and the wires: lines of gpio-sim, converters, and two networks."""
    host, network, guarded = f'10.9.0.1:{plant.PORT}', 'machines', True

    def __init__(self):
        subprocess.run('ip netns add machines && ip link add cabinet type veth peer name field netns machines && '
                       'ip addr add 10.9.0.1/24 dev cabinet && ip link set cabinet up && '
                       'ip -n machines addr add 10.9.0.2/24 dev field && ip -n machines link set field up && ip -n machines link set lo up',
                       shell=True, check=True)
        self.console = Lines('cabinet', [line for _address, line in plant.BUTTONS.values()] + plant.RELAYS)
        self.wires = Lines('machines', [f'WIRE{i}' for i in range(8)])
        self.knobs = {name: Converter(name) for name in plant.KNOBS}

    def cabinet_io(self, text):
        for n, name in enumerate(plant.KNOBS):
            text = text.replace(f'device=ads1015 channel=voltage{n} ', f'device={name} channel=voltage0 ')
        return text

    def machines_io(self):
        return MACHINES_GPIO

    def begin(self, cabinet, machines):
        for _address, line in plant.BUTTONS.values():
            self.console.pull(line, True)

    def button(self, name, closed):
        """A closed contact pulls its line down."""
        self.console.pull(plant.BUTTONS[name][1], not closed)

    def knob(self, name, volts):
        self.knobs[name].measure(volts)

    def relays(self):
        return [self.console.value(line) for line in plant.RELAYS]

    def wire(self, n, level):
        self.wires.pull(f'WIRE{n}', level)

    def connect(self):
        pass

    def end(self):
        for thing in (self.console, self.wires, *self.knobs.values()):
            thing.close()
        subprocess.run('ip link del cabinet && ip netns del machines', shell=True, check=True)


def test_the_cement_plant_runs_on_two_boards():
    plant.run(Kernel())


def main():
    subprocess.run(['ip', 'link', 'set', 'lo', 'up'], check=True)
    tests = {name[5:]: test for name, test in globals().items() if name.startswith('test_')}
    if len(sys.argv) > 3:
        tests = {name: test for name, test in tests.items() if name in (sys.argv[3], sys.argv[3].replace('test_', '', 1))}
        if not tests:
            print('1..1\nnot ok 1 - field: there is no test ' + sys.argv[3])
            return True
    print(f'1..{len(tests)}', flush=True)
    failed = 0
    for number, (name, test) in enumerate(tests.items(), 1):
        began = time.monotonic()
        good = True
        try:
            test()
        except Exception:  # pylint: disable=broad-except
            good = False
            for line in traceback.format_exc().splitlines():
                tell(line[-1500:])
        failed += not good
        print(f"{'ok' if good else 'not ok'} {number} - field: {name.replace('_', ' ')}")
        tell(f'{name} took {time.monotonic() - began:.1f} s of this guest\'s time')
    return failed != 0


if __name__ == '__main__':
    sys.exit(main())
