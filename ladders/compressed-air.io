BOARD "Raspberry Pi, Compressed air"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Acknowledge

%QX0.0  gpio  line=GPIO23  safe=0  # Motor
%QX0.1  gpio  line=GPIO24  safe=0  # Release
%QX0.2  gpio  line=GPIO25  safe=0  # Lamp

# ADS1115 on I2C (docs/field.md); a transmitter of 4 to 20 mA for 0 to 16 bar, with a resistor of 150 Ohm.
%IW2  iio  device=ads1015 channel=voltage0  range=0..1600 at 0.6V..3V  limits=0.54V..3.15V substitute=-1
