BOARD "Raspberry Pi, Tank level"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Auto
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # HandFill
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # OverfillOk
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Demand
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms  # PumpOk

%QX0.0  gpio  line=GPIO23  safe=0  # FillValve
%QX0.1  gpio  line=GPIO24  safe=0  # OutletPump
%QX0.2  gpio  line=GPIO25  safe=0  # LowLamp
%QX0.3  gpio  line=GPIO12  safe=0  # HighLamp
%QX0.4  gpio  line=GPIO16  safe=0  # SensorLamp

# ADS1115 on I2C (docs/field.md); a resistor of 150 Ohm makes 0 to 3 V of 0 to 20 mA.
%AIW0  iio  device=ads1015 channel=voltage0  range=0..32000 at 0V..3V  filter=50ms substitute=0
