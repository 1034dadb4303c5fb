# The three units of the cement plant. In place of the DUT7000 stands a board that is wired as
# ladders/boards/raspberry-pi.io says, with a converter ADS1115 for the knobs; the modules are two
# DUT6000 on RS485.

BOARD "Cement plant, main cabinet"
BUS rs485 modbus-rtu port=/dev/ttyS1 baud=19200 parity=even timeout=100ms

# Console. A closed contact pulls its line down: an open one, and a broken wire, is FALSE.
%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms   # emergency stop, closed while all is well
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms   # acknowledge
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms   # mix
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms   # stop mixing, closed while all is well
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms   # execute, mixer
%IX0.5  gpio  line=GPIO13  pull-up active-low debounce=5ms   # gate open
%IX0.6  gpio  line=GPIO19  pull-up active-low debounce=5ms   # gate close
%IX0.7  gpio  line=GPIO26  pull-up active-low debounce=5ms   # discharge finished

# Knobs with three positions: 0, 1.65 and 3.3 V. The kernel calls an ADS1115 ads1015, too.
%AIW0   iio   device=ads1015 channel=voltage0 range=0..27648 at 0V..3.3V filter=50ms substitute=0   # hopper
%AIW2   iio   device=ads1015 channel=voltage1 range=0..27648 at 0V..3.3V filter=50ms substitute=0   # mixer
%AIW4   iio   device=ads1015 channel=voltage2 range=0..27648 at 0V..3.3V filter=50ms substitute=0   # direction of the discharge

# Starter 1 with its relays, and the lamp.
%QX0.0  gpio  line=GPIO23  safe=0   # compressor, soft-start relay
%QX0.1  gpio  line=GPIO24  safe=0   # screw A
%QX0.2  gpio  line=GPIO25  safe=0   # screw B
%QX0.3  gpio  line=GPIO12  safe=0   # starter 1
%QX0.4  gpio  line=GPIO16  safe=0   # compressor, bypass relay
%QX0.5  gpio  line=GPIO20  safe=0   # screw A
%QX0.6  gpio  line=GPIO21  safe=0   # screw B
%QX0.7  gpio  line=GPIO18  safe=0   # alarm lamp

# Inputs of a module that does not answer for a second are 0: over-currents trip, load cells are broken.
%XIB0..2  module  bus=rs485 unit=1 type=DUT6000 stale=1s substitute=0 safe=0   # box at the hopper
%XIB3..5  module  bus=rs485 unit=2 type=DUT6000 stale=1s substitute=0 safe=0   # main cabinet
