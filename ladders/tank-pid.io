BOARD "Raspberry Pi, Tank with PID"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Run
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # ByHand
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # WaterOk
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # LimitOk
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms  # Simulate

%QX0.0  gpio  line=GPIO23  safe=0  # Heater
%QX0.1  gpio  line=GPIO24  safe=0  # Ready
%QX0.2  gpio  line=GPIO25  safe=0  # Trouble

# ADS1115 on I2C (docs/field.md); a resistor of 150 Ohm makes 0 to 3 V of 0 to 20 mA.
%AIW0  iio  device=ads1015 channel=voltage0  range=0..32000 at 0V..3V  filter=200ms substitute=0
