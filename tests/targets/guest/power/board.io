BOARD "cut"
%QX0.0 sim
