BOARD "Raspberry Pi, Dosing"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Start
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # Stop
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # Shut
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Ask
%IX0.5  gpio  line=GPIO6   pull-up active-low debounce=5ms  # Clean
%IX0.4  gpio  line=GPIO13  pull-up active-low debounce=5ms  # Quit

%QX0.0  gpio  line=GPIO23  safe=0  # Coarse
%QX0.1  gpio  line=GPIO24  safe=0  # Fine
%QX0.2  gpio  line=GPIO25  safe=0  # Gate
%QX0.3  gpio  line=GPIO12  safe=0  # Wrong
%QX0.4  gpio  line=GPIO16  safe=0  # TooLong
%QX0.5  gpio  line=GPIO20  safe=0  # Service

# ADS1115 on I2C (docs/field.md); the amplifier of the scale gives 0 to 3 V for 0 to 300 kg, ten a kilogram.
%AIW0  iio  device=ads1015 channel=voltage0  range=0..3000 at 0V..3V  poll=20ms substitute=hold
