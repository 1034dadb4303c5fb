BOARD "sensor"
%IW0 hwmon device=tmp105 channel=temp1 poll=50ms stale=500ms substitute=-1
%QW0 sim safe=0
