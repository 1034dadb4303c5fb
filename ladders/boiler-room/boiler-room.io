BOARD "Raspberry Pi, boiler room"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Demand
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # Flame
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # LimitOk
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Reset
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms  # GasPulse

%QX0.0  gpio  line=GPIO23  safe=0  # Fan
%QX0.1  gpio  line=GPIO24  safe=0  # Gas
%QX0.2  gpio  line=GPIO25  safe=0  # Spark
%QX0.3  gpio  line=GPIO16  safe=0  # Pump
%QX0.4  gpio  line=GPIO20  safe=0  # Lamp

# ADS1115 and MCP4725 on I2C (docs/field.md).
%AIW0  iio  device=ads1015 channel=voltage0  range=-500..500 at 0V..3.3V  # RawOut
%AIW2  iio  device=ads1015 channel=voltage1  range=0..1000 at 0V..3.3V  # RawFlow
%QW2   iio  device=mcp4725 channel=voltage0  range=0..1000 at 0V..3.3V  # Display
