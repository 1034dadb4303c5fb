BOARD "Raspberry Pi with converters and expanders"
# docs/field.md: the lines that config.txt needs for each chip, and how it is wired. Delete the
# lines of chips that you do not have: ladderd starts when all that the map names is there.

# ADS1115 on I2C, four inputs of 0 to 4.096 V; for 0 to 10 V a divider of 15 and 10 kOhm is before each
%AIW0  iio  device=ads1015 channel=voltage0  range=0..27648 at 0V..4V  filter=50ms
%AIW2  iio  device=ads1015 channel=voltage1  range=0..27648 at 0V..4V  filter=50ms
%AIW4  iio  device=ads1015 channel=voltage2  range=0..27648 at 0V..4V  filter=50ms
%AIW6  iio  device=ads1015 channel=voltage3  range=0..27648 at 0V..4V  filter=50ms

# MCP3008 on SPI, eight inputs of 10 bits; here channel 0 has a shunt of 150 Ohm for 4 to 20 mA
%AIW8   iio  device=mcp3008 channel=voltage0  range=0..27648 at 0.6V..3V  limits=0.54V..3.15V substitute=0
%AIW10  iio  device=mcp3008 channel=voltage1  range=0..27648 at 0V..3.3V
%IX10.0 iio  device=mcp3008 channel=voltage2  threshold=2V hysteresis=200mV   # a contact on an analog input

# DS18B20 on 1-wire, hundredths of a degree; its number is in /sys/bus/w1/devices
%AIW20  w1   sensor=28-000005e2fdc3  stale=5s

# The processor's own temperature
%AIW22  hwmon  device=cpu_thermal channel=temp1

# MCP4725 on I2C, 0 to 3.3 V
%AQW0  iio  device=mcp4725 channel=voltage0  range=0..27648 at 0V..3.3V  safe=0

# PCA9685 on I2C, sixteen outputs; all have one period
%AQW2  pwm  chip=pca9685-pwm channel=0 period=20ms  safe=0
%AQW4  pwm  chip=pca9685-pwm channel=1 period=20ms  safe=0

# MCP23017 on I2C, sixteen lines. The kernel switches none of its pull-ups on: here a contact closes to 3.3 V, and 10 kOhm
# lead to ground. So the input is off when a wire breaks, and also when the chip has gone. An output that must become safe
# is better at a line of the board: docs/field.md
%IX20.0  gpio  chip=mcp23017 offset=0
%QX20.0  gpio  chip=mcp23017 offset=8  safe=0

# PCF8574 on I2C, eight lines; an input is one that is written high
%IX21.0  gpio  chip=pcf8574 offset=0  active-low
%QX21.0  gpio  chip=pcf8574 offset=4  active-low safe=0
