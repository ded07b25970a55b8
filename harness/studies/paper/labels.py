"""Labels of axes, with the scales that make their quantities dimensionless, or 1."""

TIME = "time $\\tau$ [$1 / \\omega_0$]"
DISPLACEMENT = "displacement [$x_0$]"
STEADY_VELOCITY = "steady velocity $V$ [$x_0 \\omega_0$]"
FREQUENCY = "drive frequency $\\Omega$ [$\\omega_0$]"
RATIO = "frequency ratio $\\lambda$ [1]"
LOAD = "load $L$ [$m x_0 \\omega_0^2$]"
