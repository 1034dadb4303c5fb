BOARD "Raspberry Pi, Panel text"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Auto
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # Runs
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # MotorOk
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # LevelOk
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms  # DoorOk
%IX0.5  gpio  line=GPIO13  pull-up active-low debounce=5ms  # Button

%QX0.0  gpio  line=GPIO23  safe=0  # Horn

# ADS1115 on I2C (docs/field.md); a probe of 4 to 20 mA for 0 to 4 m, with a resistor of 150 Ohm.
%AIW0  iio  device=ads1015 channel=voltage0  range=0..4000 at 0.6V..3V  limits=0.54V..3.15V filter=200ms substitute=hold
