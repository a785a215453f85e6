# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Records the calls of a MORSE builder script, and writes the scene as a Playpen world.

The names are those of MORSE 1.4's package morse.builder. A class that has no counterpart in Playpen
raises NotApplicable with the reason.
"""
import inspect
import json
import math
import os
import struct


class NotApplicable(Exception):
    """The scene needs what Playpen does not have."""


def degrees(angle):
    return math.degrees(angle)


class Place:
    """What MORSE calls an object: a place, properties and a name."""

    def __init__(self, name=None):
        self.basename = name
        self.location = [0.0, 0.0, 0.0]
        self.rotation = [0.0, 0.0, 0.0]
        self.props = {}
        self.children = []
        self.parent = None
        Scene.current.all.append(self)

    @property
    def name(self):
        return self.basename

    @name.setter
    def name(self, value):
        self.basename = value

    def translate(self, x=0.0, y=0.0, z=0.0):
        self.location = [self.location[0] + x, self.location[1] + y, self.location[2] + z]

    def rotate(self, x=0.0, y=0.0, z=0.0):
        self.rotation = [self.rotation[0] + x, self.rotation[1] + y, self.rotation[2] + z]

    def properties(self, **values):
        self.props.update(values)

    def append(self, child, level=1):
        child.parent = self
        self.children.append(child)
        frame = inspect.stack()[level].frame
        names = dict(frame.f_locals)
        if "self" in names:
            names = {**vars(names["self"]), **names}
        for name, value in names.items():
            if value is child and not child.basename:
                child.basename = name

    # Interfaces: every component of Playpen has both.
    def add_stream(self, *_, **__):
        pass

    add_service = add_interface = add_default_interface = add_stream
    configure_stream_manager = configure_service = add_stream
    create_laser_arc = unparent_wheels = profile = add_stream

    def mount(self):
        """Settings of sim::SensorMount."""
        x, y, z = self.location
        roll, pitch, yaw = self.rotation
        made = {"x": x, "y": y, "z": z, "yaw_deg": degrees(yaw), "pitch_deg": degrees(pitch),
                "roll_deg": degrees(roll)}
        if isinstance(self.parent, Armature):
            # MORSE's places count from the arm's base at rest, Playpen's from the last link, whose
            # x axis points up at rest.
            x, z = z - self.parent.length(), -x
            made.update({"x": x, "z": z, "pitch_deg": 90.0})
        made = {key: value for key, value in made.items() if value != 0.0}
        if isinstance(self.parent, Component):
            made["on"] = self.parent.name
        return made

    def planar_mount(self):
        return {"x": self.location[0], "y": self.location[1], "yaw_deg": degrees(self.rotation[2])}


class Scene:
    """All objects of a script."""
    current = None

    def __init__(self):
        self.all = []
        self.environment = None
        Scene.current = self

    def robots(self):
        return [o for o in self.all if isinstance(o, Robot)]


def close_context(level=1):
    """Names the robots and objects of the caller's variables, as MORSE does."""
    frame = inspect.stack()[level].frame
    for name, value in frame.f_locals.items():
        if isinstance(value, Place) and value.parent is None and not value.basename:
            value.basename = name
            taken = [o.basename for o in Scene.current.all if o is not value and o.parent is None]
            number = 1
            while value.basename in taken:
                value.basename = "%s.%03d" % (name, number)
                number += 1


class AbstractComponent:
    @staticmethod
    def close_context(level=1):
        close_context(level + 1)


# --- Robots

# MORSE's robots take any speed at once.
MOTORS = {"max_speed": 20.0, "max_turn_rate_deg": 3600.0}


class Robot(Place):
    """Shape and height of the body's origin over the floor."""
    footprint = (1.1, 0.8)
    origin_m = 0.0
    body_m = 0.7
    friction = 0.5  # of Blender's materials, unless set otherwise

    def world(self):
        x, y, z = self.location
        roll, pitch, yaw = self.rotation
        devices = {c.name: c.device() for c in self.components()}
        kinds = [device["type"] for device in devices.values()]
        if "motion" not in kinds and ("waypoint" in kinds or "destination" in kinds):
            devices["motors"] = {"type": "motion", **MOTORS}  # through which those drive
        for device in devices.values():
            if device["type"] == "motion":
                device["speed_loss"] = self.speed_loss()
                device["turn_loss_deg"] = degrees(0.04 * self.friction)  # fits MORSE's vw_testing
        made = {"name": playpen_name(self.basename), "model": self.model_file(),
                "pose": {"x": x, "y": y, "yaw_deg": degrees(yaw)}, "devices": devices}
        height = z + self.origin_m
        if height or roll or pitch:
            made["elevation"] = {"z": height, "roll_deg": degrees(roll), "pitch_deg": degrees(pitch)}
        tags = [name for name, value in self.props.items() if value]
        if tags:
            made["tags"] = tags
        return made

    def components(self, of=None):
        for child in (of or self).children:
            yield child
            yield from self.components(child)

    def set_friction(self, value):
        self.friction = value

    def speed_loss(self):
        """Blender's friction slows a body down between two settings of its speed: MORSE's test of
        friction expects 1.4 m in 2 s at 1 m/s with a friction of 5, and 2 m with 0."""
        return 0.06 * self.friction

    @property
    def _bpy_object(self):
        raise NotApplicable("the scene changes settings of Blender's physics")

    def holonomic(self):
        return any(isinstance(c, (MotionXYW, Destination)) for c in self.components())

    def model_file(self):
        return "morse_%s%s.json" % (type(self).__name__.lower(), "_xyw" if self.holonomic() else "")

    def model(self):
        length, width = (0.5 * side for side in self.footprint)
        kind = "omnidirectional" if self.holonomic() else "differential"
        return {"name": self.model_file()[:-5],
                "footprint": [[length, -width], [length, width], [-length, width],
                              [-length, -width]],
                "height": self.body_m, "mass": 50,
                "drive": {"kind": kind, "wheel_radius": 0.2, "wheel_separation": 2 * width},
                "max_speed": 20, "max_turn_rate_deg": 3600, "devices": {}}


class ATRV(Robot):
    origin_m = 0.1
    friction = 0.25  # on wheels: MORSE's tests of its motion expect 2.0 m in 2.1 s


class Morsy(Robot):
    footprint = (0.4, 0.4)
    friction = 1.0  # it has no wheels: MORSE's test of its airspeed expects a loss of 0.06 m/s


class Jido(Robot):
    pass


class B21(Robot):
    pass


class FakeRobot(Robot):
    footprint = (0.2, 0.2)


class RMax(Robot):
    footprint = (2.0, 0.6)


class Pioneer3DX(Robot):
    footprint = (0.45, 0.4)
    origin_m = 0.15


class SegwayRMP400(Robot):
    footprint = (0.9, 0.8)
    origin_m = 0.1


class Victim(Robot):
    def __init__(self, name=None):
        raise NotApplicable("victims are not simulated: there is no search_and_rescue sensor")


# --- Components

class Component(Place):
    kind = None
    default_frequency = 60.0

    def __init__(self, name=None):
        super().__init__(name)
        self._frequency = self.default_frequency
        self._level = None
        self.modifiers = []
        if self.kind is None:
            raise NotApplicable(self.reason())

    def reason(self):
        return "there is no " + type(self).__name__

    def frequency(self, value):
        self._frequency = value

    def level(self, value):
        self._level = value

    def alter(self, modifier, **parameters):
        self.modifiers.append((modifier, parameters))

    def robot(self):
        owner = self.parent
        while not isinstance(owner, Robot):
            owner = owner.parent
        return owner

    def device(self):
        made = {"type": self.kind}
        if self.default_frequency:
            made["frequency"] = self._frequency
        made.update(self.settings())
        if self.modifiers:
            made["modifiers"] = [self.modifier(*m) for m in self.modifiers]
        return made

    def settings(self):
        return {}

    @staticmethod
    def modifier(name, parameters):
        made = {"name": name, **parameters}
        env = Scene.current.environment
        if name in ("ECEF", "geodetic"):
            for key in ("longitude", "latitude", "altitude", "angle_against_north"):
                if key in env.props:
                    made[key] = env.props[key]
        if name == "UTM":
            for key, of_env in (("x_offset", "UTMXOffset"), ("y_offset", "UTMYOffset"),
                                ("z_offset", "UTMZOffset")):
                if key not in made and of_env in env.props:
                    made[key] = float(env.props[of_env])
        if name in ("Noise", "PoseNoise") and "gyro_std" not in parameters:
            made.setdefault("_2D", False)
        return made


class Mounted(Component):
    def settings(self):
        return self.mount()


class Pose(Mounted):
    kind = "pose"


class Velocity(Mounted):
    kind = "velocity"


class Accelerometer(Mounted):
    kind = "accelerometer"


class Gyroscope(Mounted):
    kind = "gyroscope"


class Attitude(Mounted):
    kind = "attitude"


class Airspeed(Mounted):
    kind = "airspeed"


class Barometer(Component):
    kind = "barometer"


class RadarAltimeter(Component):
    kind = "altimeter"

    def settings(self):
        return {"range": self.props.get("MaxRange", 30.0)}


class Clock(Component):
    kind = "clock"

    def __init__(self, name=None):
        super().__init__(name)
        self._frequency = None

    def device(self):
        env = Scene.current.environment
        return {"type": "clock", "frequency": self._frequency or env.frequency}


class IMU(Component):
    kind = "imu"

    def settings(self):
        # The parameters of the world's noise: MORSE's own has white noise in its default.
        return {}


class GPS(Component):
    kind = "gps"

    def settings(self):
        made = {"level": self._level or "simple"}
        env = Scene.current.environment
        for key, of_env in (("longitude_deg", "longitude"), ("latitude_deg", "latitude"),
                            ("altitude", "altitude")):
            if of_env in env.props:
                made[key] = env.props[of_env]
        return made


class Odometry(Component):
    kind = "odometry"

    def settings(self):
        return {"level": self._level or "integrated"}


class Battery(Component):
    kind = "battery"

    def settings(self):
        # A percent of 1 Wh is 36 J: a rate in percent a second times 36 W.
        power = 36.0 * self.props.get("DischargingRate", 0.05)
        return {"capacity": 1.0, "idle_power": power, "drive_power": 0.0, "charging_power": power}


class Collision(Component):
    kind = "collision"


class Proximity(Component):
    kind = "proximity"
    default_frequency = 12.0

    def settings(self):
        return {"range": self.props.get("Range", 100.0), "track": self.props.get("Track", "Robot_Tag"),
                "obstacles": True}


class Thermometer(Component):
    kind = "thermometer"

    def settings(self):
        return {"air": float(self.props.get("DefaultTemperature", 15.0))}


class Laser(Component):
    """Beams from right to left."""
    kind = "laser"
    default_frequency = 10.0
    window_deg = 180.0
    resolution_deg = 1.0
    range_m = 30.0

    def settings(self):
        return {"beams": int(self.window_deg / self.resolution_deg) + 1,
                "resolution_deg": self.resolution_deg,
                "range_max": self.props.get("laser_range", self.range_m),
                "pose": self.planar_mount(), "height": 0.1 + self.location[2]}


class Sick(Laser):
    pass


class Hokuyo(Laser):
    window_deg = 270.0
    resolution_deg = 0.25


class Infrared(Laser):
    window_deg = 20.0
    range_m = 2.0


class SemanticCamera(Component):
    kind = "semantic_camera"
    default_frequency = 20.0

    def settings(self):
        focal = self.props.get("cam_focal", 35.0)
        made = {"tag": self.props.get("tag", "Object"),
                "relative": bool(self.props.get("relative", False)),
                "occlusion": not self.props.get("noocclusion", False),
                "field_of_view_deg": 2.0 * degrees(math.atan(16.0 / focal)), "range": 100.0}
        made.update(self.mount())
        return made


class VideoCamera(Component):
    kind = "camera"
    near_m = 0.1
    far_m = 100.0

    def settings(self):
        # The larger side of a picture is 32 focal lengths of 1 mm.
        width = self.props.get("cam_width", 256)
        height = self.props.get("cam_height", 256)
        half = 16.0 / self.props.get("cam_focal", 25.0) * width / max(width, height)
        base = self.robot().origin_m
        return {"image": [width, height], "field_of_view_deg": 2.0 * degrees(math.atan(half)),
                "range_max": self.props.get("cam_far", self.far_m),
                "pose": self.planar_mount(), "height": base + self.location[2]}


class DepthCamera(VideoCamera):
    kind = "depth_camera"
    near_m = 1.0
    far_m = 20.0

    def settings(self):
        return dict(super().settings(), range_min=self.props.get("cam_near", self.near_m))


class Light(Component):
    kind = "blinkenlight"
    default_frequency = None

    def settings(self):
        return {"enabled": self.props.get("emit", True), "period": 0}


class Gripper(Component):
    kind = "hand"

    def settings(self):
        made = {"angle_deg": self.props.get("Angle", 60.0),
                "distance": self.props.get("Distance", 0.5)}
        made.update(self.mount())
        return made


class PTUPosture(Component):
    kind = "posture"

    def settings(self):
        return {"of": self.parent.name}


class ArmaturePose(PTUPosture):
    pass


class Actuator(Component):
    default_frequency = None


class MotionVW(Actuator):
    kind = "motion"

    def settings(self):
        return dict(MOTORS)


class MotionVWDiff(MotionVW):
    pass


class MotionXYW(MotionVW):
    pass


class Waypoint(Actuator):
    kind = "waypoint"

    def settings(self):
        # MORSE's keeps its speed up to its goal, turns at half of it, and rolls out after a stop:
        # the deceleration fits MORSE's waypoint_testing.
        return {"approach_gain": 50.0, "turn_gain": 4.0, "max_turn_rate_deg": degrees(0.5),
                "stop_deceleration": 3.0}


class Destination(Actuator):
    kind = "destination"

    def settings(self):
        return {"speed": self.props.get("Speed", 5.0), "tolerance": self.props.get("Tolerance", 0.5),
                "remain": self.props.get("RemainAtDestination", False)}


class Teleport(Actuator):
    kind = "teleport"


class Orientation(Actuator):
    kind = "orientation"

    def settings(self):
        return {"speed_deg": degrees(self.props.get("speed", 0.0))}


class PTU(Component):
    kind = "ptz"

    def settings(self):
        speed = degrees(self.props.get("Speed", 1.0))
        made = {"pan_max_deg": 180.0, "tilt_max_deg": 90.0, "pan_speed_deg": speed,
                "tilt_speed_deg": speed}
        made.update(self.mount())
        # The head's place counts from the robot's origin, as MORSE's does.
        return made


class Armature(Component):
    kind = "actarray"
    joints = ()

    def length(self):
        return sum(joint["length"] for joint in self.joints)

    def settings(self):
        return {"pose": self.planar_mount(), "height": self.location[2], "pitch_deg": -90.0,
                "joints": [dict(joint) for joint in self.joints]}


class KukaLWR(Armature):
    """Lengths as in MORSE's test of its joints' lengths; the arm stands upright at rest."""
    joints = [{"name": "kuka_%d" % (i + 1), "length": length, "axis": axis,
               "min_deg": -limit, "max_deg": limit, "home_deg": 0, "centre_deg": 0,
               "speed_deg": degrees(0.8), "speed_max_deg": 3600,
               "acceleration_deg": 36000, "acceleration_max_deg": 36000}
              for i, (length, axis, limit) in enumerate((
                  (0.31, "x", 170), (0.20, "-y", 120), (0.20, "x", 170), (0.20, "y", 120),
                  (0.19, "x", 170), (0.08, "-y", 120), (0.13, "x", 170)))]


def missing(name, reason):
    return type(name, (Component,), {"reason": lambda self: reason})


_FLIES = "robots stay on the plane: nothing flies"
_FORCES = "MORSE's forces of air and floor are not simulated"
_PICTURES = "a view of columns cannot equal Blender's pictures"

Magnetometer = missing("Magnetometer", "there is no model of the Earth's magnetic field")
SearchAndRescue = missing("SearchAndRescue", "victims are not simulated: there is no search_and_rescue sensor")
Drag = missing("Drag", _FORCES)
ExternalForce = missing("ExternalForce", _FORCES)
SteerForce = missing("SteerForce", _FORCES)
ForceTorque = missing("ForceTorque", _FORCES)
RotorcraftWaypoint = missing("RotorcraftWaypoint", _FLIES)
RotorcraftVelocity = missing("RotorcraftVelocity", _FLIES)
RotorcraftAttitude = missing("RotorcraftAttitude", _FLIES)
StabilizedQuadrotor = missing("StabilizedQuadrotor", _FLIES)
QuadrotorDynamicControl = missing("QuadrotorDynamicControl", _FLIES)


class Quadrotor(Robot):
    def __init__(self, name=None):
        raise NotApplicable(_FLIES)


class QUAD2012(Quadrotor):
    pass


class Hummer(Robot):
    def __init__(self, name=None):
        raise NotApplicable(_FORCES)


class Submarine(Robot):
    def __init__(self, name=None):
        raise NotApplicable(_FLIES)


# --- The scene

class PassiveObject(Place):
    """An object of MORSE's library: a small box."""

    def __init__(self, filename="props/objects", prefix=None):
        super().__init__()
        self.prefix = prefix


class Zone(Place):
    def __init__(self, type="Charging"):
        super().__init__()
        self.type = type
        self.size = [1.0, 1.0, 1.0]


class Cube(PassiveObject):
    def __init__(self, name=None):
        super().__init__()
        self.basename = name


class Sphere(Cube):
    pass


# The boxes of MORSE's environment indoors-1/boxes near its origin: MORSE's tests state where their
# faces and tops are (sick, radar altimeter, semantic camera, communication).
BOXES = {
    "RedBox": (-7.48, 0.0, 0.96), "BlueBox": (-3.48, -3.0, 0.96), "GreenBox": (-6.4, 5.98, 0.96),
}
BOX_HEIGHT = 1.86
COLOURS = {"RedBox": "#ff0000", "BlueBox": "#0000ff", "GreenBox": "#00ff00"}
ENVIRONMENTS = ("empty", "indoors-1/boxes")


class GameObject:
    def __init__(self):
        self.game = type("Game", (), {"use_actor": False})()
        self.props = {}


class Blender:
    """The part of morse.builder.bpymorse that tests use."""

    def get_object(self, name):
        return Scene.current.environment_objects.setdefault(name, GameObject())

    def properties(self, obj, **values):
        obj.props.update(values)


bpymorse = Blender()


class Environment(Place):
    def __init__(self, filename="empty", fastmode=False):
        close_context(2)
        super().__init__("environment")
        self.filename = filename
        self.frequency = 60.0
        self.sync_port = None
        Scene.current.environment = self
        Scene.current.environment_objects = getattr(Scene.current, "environment_objects", {})
        if filename not in ENVIRONMENTS:
            raise NotApplicable("the environment %s is a landscape" % filename)

    def properties(self, **values):
        """Blender stores numbers in single precision."""
        for key, value in values.items():
            if isinstance(value, float):
                value = struct.unpack("f", struct.pack("f", value))[0]
            self.props[key] = value

    def simulator_frequency(self, value):
        self.frequency = value

    def configure_stream_manager(self, *_, **options):
        self.sync_port = options.get("sync_port") if options.get("time_sync") else None

    def ignored(self, *_, **__):
        pass

    set_camera_location = set_camera_rotation = show_framerate = show_debug_properties = ignored
    show_physics = set_material_mode = create = set_time_strategy = set_gravity = ignored


def playpen_name(name):
    return (name or "object").replace(".", "_")


def write_world(scene, folder):
    """Writes the scene as world.json, with its robot models. Returns the path."""
    env = scene.environment
    reach = 300.0
    obstacles = []
    docks = []
    if env.filename == "indoors-1/boxes":
        for name, (x, y, side) in BOXES.items():
            props = getattr(scene, "environment_objects", {}).get(name)
            tags = ["Object"] + ([str(props.props["Type"])] if props and "Type" in props.props else [])
            obstacles.append({"name": name, "center": [x, y], "size": [side, side],
                              "height": BOX_HEIGHT, "tags": tags, "colour": COLOURS[name]})
    for o in scene.all:
        if isinstance(o, PassiveObject):
            tags = [key for key, value in o.props.items() if value is True]
            side = BOXES[o.prefix][2] if o.prefix in BOXES else 0.3
            made = {"name": playpen_name(o.basename or o.prefix), "center": o.location[:2],
                    "size": [side, side], "height": BOX_HEIGHT if o.prefix in BOXES else 0.5,
                    "tags": tags, "portable": "Graspable" in tags}
            if o.prefix in COLOURS:
                made["colour"] = COLOURS[o.prefix]
            obstacles.append(made)
        if isinstance(o, Zone):
            docks.append({"pose": {"x": o.location[0], "y": o.location[1]},
                          "size": [2.0 * o.size[0], 2.0 * o.size[1]]})
    robots = scene.robots()
    # MORSE's robots may start inside one another and jump apart; here they stand side by side.
    taken = set()
    for robot in robots:
        while tuple(round(c, 3) for c in robot.location[:2]) in taken:
            robot.location[1] += 2.0
        taken.add(tuple(round(c, 3) for c in robot.location[:2]))
    world = {"name": env.filename.replace("/", "_"),
             "arena": {"size": [2 * reach, 2 * reach], "origin": [-reach, -reach],
                       "obstacles": obstacles, "docks": docks},
             "simulation": {"time": "real", "step": round(1.0 / env.frequency, 9)},
             "canvas": {"size": [16, 16], "cell_size": 8.0},
             "robots": [robot.world() for robot in robots]}
    for robot in robots:
        with open(os.path.join(folder, robot.model_file()), "w") as file:
            json.dump(robot.model(), file, indent=1)
    path = os.path.join(folder, "world.json")
    with open(path, "w") as file:
        json.dump(world, file, indent=1)
    return path
