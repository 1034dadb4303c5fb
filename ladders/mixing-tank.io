BOARD "Raspberry Pi, Mixing tank"
# Made for the 40 pins; other pins are as good. Inputs: a contact from the pin to ground.

%IX0.0  gpio  line=GPIO17  pull-up active-low debounce=5ms  # Start
%IX0.1  gpio  line=GPIO27  pull-up active-low debounce=5ms  # PulseA
%IX0.2  gpio  line=GPIO22  pull-up active-low debounce=5ms  # PulseB
%IX0.3  gpio  line=GPIO5   pull-up active-low debounce=5ms  # Empty
%IX0.4  gpio  line=GPIO6   pull-up active-low debounce=5ms  # Abort
%IX0.5  gpio  line=GPIO13  pull-up active-low debounce=5ms  # Ack
%IX0.6  gpio  line=GPIO19  pull-up active-low debounce=5ms  # Wait

%QX0.0  gpio  line=GPIO23  safe=0  # ValveA
%QX0.1  gpio  line=GPIO24  safe=0  # ValveB
%QX0.2  gpio  line=GPIO25  safe=0  # Heater
%QX0.3  gpio  line=GPIO12  safe=0  # Stirrer
%QX0.4  gpio  line=GPIO16  safe=0  # Fast
%QX0.5  gpio  line=GPIO20  safe=0  # Outlet
%QX0.6  gpio  line=GPIO21  safe=0  # Fan
%QX0.7  gpio  line=GPIO18  safe=0  # BatchLamp
%QX1.0  gpio  line=GPIO7   safe=0  # FaultLamp
%QX1.1  gpio  line=GPIO8   safe=0  # Horn
%QX1.2  gpio  line=GPIO9   safe=0  # Warning

# DS18B20 on 1-wire (docs/field.md), dtoverlay=w1-gpio; its number is in /sys/bus/w1/devices.
%AIW0  w1  sensor=28-000005e2fdc3  range=-550..1250 at -55C..125C  stale=5s
