# A project of ClassicLadder with one part more than a project can have.
use strict;
use warnings;

open my $to, '>:raw', 'main.rung' or die "main.rung: $!\n";
print $to "_FILES_CLASSICLADDER\n";
print $to "_FILE-x$_.txt\n_/FILE-x$_.txt\n" for 0 .. 20_000;
print $to "_/FILES_CLASSICLADDER\n";
close $to or die "main.rung: $!\n";
