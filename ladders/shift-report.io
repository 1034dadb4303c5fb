BOARD "Raspberry Pi, Shift report"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Good
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # Bad
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # Runs
%IX1.0  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Switch bit 0
%IX1.1  gpio  line=GPIO6   pull-up active-low debounce=5ms  # Switch bit 1
%IX1.2  gpio  line=GPIO13  pull-up active-low debounce=5ms  # Switch bit 2
%IX1.3  gpio  line=GPIO19  pull-up active-low debounce=5ms  # Switch bit 3
%IX1.4  gpio  line=GPIO26  pull-up active-low debounce=5ms  # Switch bit 4
%IX1.5  gpio  line=GPIO9   pull-up active-low debounce=5ms  # Switch bit 5
%IX1.6  gpio  line=GPIO10  pull-up active-low debounce=5ms  # Switch bit 6
%IX1.7  gpio  line=GPIO11  pull-up active-low debounce=5ms  # Switch bit 7

%QX0.0  gpio  line=GPIO23  safe=0  # AskLamp

# MCP4725 on I2C (docs/field.md), 0 to 3.3 V for the meter.
%QW2  iio  device=mcp4725 channel=voltage0  range=0..1000 at 0V..3.3V  safe=0
