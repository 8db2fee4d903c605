# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of layers: which folder may include what. check_layers.py enforces it.

A layer owns `folders` and the public headers under `headers` (the longest match decides), wherever these lie. It may include its own headers
and those of the layers that `may` names; a forward declaration of a name in another layer's `namespaces` or of one of its
classes counts as an include. `libraries` are third-party libraries that its private files may use, and `public_libraries`
those that its public headers may show. Layers of one `module` are rooms of one library: they may include each other's
private headers, as "room/header.hpp", where `may` allows it. Folders outside the table (tests/, bench/) may include anything.
"""
import graphlib
from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    name: str
    folders: tuple
    headers: tuple = ()
    may: tuple = ()
    libraries: tuple = ()
    public_libraries: tuple = ()
    siblings: bool = True  # whether its subfolders may see each other
    module: str = ""  # the folder that includes of its rooms start from


COMPONENT = ("component_api", "patterns", "idl", "base")
ENDPOINTS = ("patterns_endpoints", "idl", "base")
DEVICE = ("hw_api", "geometry", *COMPONENT)
DRIVER = ("hw_driver", "hw_framing", "hw_link", "geometry_objects", *DEVICE)
PATTERNS = "src/patterns"
GRAPH, PLUGIN, HOST = "src/runtime/graph", "src/runtime/plugin", "src/runtime/host"
SUPERVISOR = "src/runtime/supervisor"
BATCH = "src/runtime/batch"
SIM_MODEL = ("robot_file", "geometry", "image", "xml", "base")
SIM_RAYS = ("sim_model", *SIM_MODEL)
SIM_SENSORS = ("sim_rays", *SIM_RAYS)
SIM_MOTION = ("sim_sensors", *SIM_SENSORS)
SIM_WORLD = ("sim_motion", *SIM_MOTION)
SIM_FILES = ("sim_generators", "sim_world", *SIM_WORLD)

LAYERS = (
    Layer("base", ("src/base",), ("orca/base/",), libraries=("fmt",)),
    Layer("log", ("src/base/log",), (), ("base",), ("spdlog", "fmt")),
    Layer("executive", ("src/base/executive",), (), ("base",), ("boost",)),
    Layer("idl", ("idl",), ("orca/idl/",), ("base",)),
    Layer("xml", ("src/xml",), ("orca/xml/",), ("base",), ("tinyxml2", "fmt")),
    Layer("text", ("src/text",), ("orca/text/",), ("idl", "xml", "base")),
    Layer("geometry", ("src/geometry",), ("orca/geometry/",), ("base",)),
    Layer("recording", ("src/recording",), ("orca/recording/",), ("base",), ("lz4", "sqlite", "zlib", "zstd")),
    Layer("carmen", ("src/recording/carmen",), ("orca/recording/carmen/",), ("geometry", "base"), ("zlib",)),
    Layer("geometry_objects", ("src/geometry/objects",), ("orca/geometry/objects/",), ("geometry", "idl", "base"),
          ("eigen",)),
    Layer("ros", ("src/interop/ros",), ("orca/ros/",), ("geometry_objects", "geometry", "idl", "base"), ("eigen",)),
    Layer("recording_objects", ("src/recording/objects",), ("orca/recording/objects/",), ("carmen", "recording", "ros", "geometry", "idl", "base")),
    Layer("robot_file", ("src/robot_file",), ("orca/robot_file/",), ("geometry", "xml", "base"), ("eigen",), ("eigen",)),
    Layer("collision", ("src/collision",), ("orca/collision/",), ("geometry", "base"), ("eigen", "fcl"), ("eigen",)),
    Layer("navigation", ("src/navigation",), ("orca/navigation/",), ("geometry", "base"), ("eigen",)),
    Layer("tracking", ("src/tracking",), ("orca/tracking/",), ("navigation", "geometry", "base")),
    Layer("image", ("src/image",), ("orca/image/",), ("base",), ("png",)),
    Layer("maps", ("src/maps",), ("orca/maps/",), ("image", "geometry", "xml", "idl", "base"), ("yaml",)),
    Layer("keys", ("src/keys",), ("orca/keys/",), ("base",), ("openssl",)),
    Layer("patterns", ("src/patterns",), ("orca/patterns/",), ENDPOINTS, ("fmt",)),  # its handles need them inside only
    Layer("patterns_endpoints", ("src/patterns/endpoints",),
          ("orca/patterns/endpoints/", "orca/patterns/counters.hpp", "orca/patterns/request_id.hpp",
           "orca/patterns/update_rate.hpp"), ("idl", "base"), ("fmt",)),
    Layer("patterns_local", ("src/patterns/local",), ("orca/patterns/local/",), ENDPOINTS, ("fmt",)),
    Layer("patterns_frames", (f"{PATTERNS}/frames",), (), ENDPOINTS, ("fmt",), module=PATTERNS),
    Layer("patterns_shm", (f"{PATTERNS}/shm",), ("orca/patterns/shm/",), ("patterns_frames", *ENDPOINTS), ("fmt",),
          module=PATTERNS),
    Layer("patterns_dds", (f"{PATTERNS}/dds",), ("orca/patterns/dds/",), ENDPOINTS, ("fmt",)),
    Layer("dds_security", (f"{PATTERNS}/dds/security",), ("orca/dds/",), ("keys", "base"), ("fastdds",), ("fastdds",)),
    Layer("patterns_dds_backend", (f"{PATTERNS}/dds/backend",), (), ("dds_security", "patterns_dds", "patterns_frames", *ENDPOINTS),
          ("fastdds", "fastcdr", "fmt"), module=PATTERNS),
    Layer("patterns_dds_ros", (f"{PATTERNS}/dds/ros", f"{PATTERNS}/dds/team"), (), ("patterns_dds", "patterns_dds_backend", "ros", *ENDPOINTS),
          ("fastdds", "fastcdr", "fmt"), module=PATTERNS),
    Layer("component_api", ("src/component_api", "cmake/plugin"), ("orca/component.hpp", "orca/component/"),
          ("patterns", "idl", "base"), ("fmt",)),
    Layer("layout_probe", ("cmake/plugin/layout_probe",), (), DEVICE),  # sees what any plugin can see
    Layer("hw_link", ("src/hw/link",), ("orca/hw/link/",), ("base",)),
    Layer("hw_api", ("src/hw/api",), ("orca/hw/", "orca/hardware.hpp"), ("hw_link", "geometry", *COMPONENT), ("fmt",)),
    Layer("hw_framing", ("src/hw/framing",), ("orca/hw/framing/",)),  # emulators use it too
    Layer("hw_nomad_scout", ("src/hw/nomad_scout",), ("orca/hw/nomad_scout/",), ("hw_framing", "geometry", "base")),
    Layer("hw_p2os", ("src/hw/p2os",), ("orca/hw/p2os/",), ("hw_framing", "geometry", "base")),
    Layer("hw_driver", ("src/hw/driver",), tuple(f"orca/hw/{name}.hpp" for name in (
        "arrivals", "base_driver", "base_figures", "base_odometry", "base_senses", "emulated_device", "frame_session", "laser_driver", "laser_place", "line_driver", "line_frames", "line_session",
        "robot_figures")),
          ("hw_framing", "hw_link", "geometry_objects", "robot_file", "xml", *DEVICE), ("eigen", "fmt")),
    Layer("create2_driver", ("src/hw/create2/driver",), (), ("hw_create2", *DRIVER), ("fmt",)),
    Layer("nomad_scout_driver", ("src/hw/nomad_scout/driver",), (), ("hw_nomad_scout", *DRIVER), ("fmt",)),
    Layer("p2os_driver", ("src/hw/p2os/driver",), (), ("hw_p2os", *DRIVER), ("fmt",)),
    Layer("player_driver", ("src/hw/player/driver",), (), ("hw_player", *DRIVER), ("fmt",)),
    Layer("hw_sick_lms", ("src/hw/sick_lms",), ("orca/hw/sick_lms/",), ("hw_framing", "base")),
    Layer("sick_lms_driver", ("src/hw/sick_lms/driver",), (), ("hw_sick_lms", *DRIVER), ("fmt",)),
    Layer("hw_player", ("src/hw/player",), ("orca/hw/player/",), ("base",)),
    Layer("hw_create2", ("src/hw/create2",), ("orca/hw/create2/",), ("hw_framing", "geometry", "base")),
    Layer("rplidar_driver", ("src/hw/rplidar/driver",), (), ("hw_rplidar", *DRIVER), ("fmt",)),
    Layer("hw_rplidar", ("src/hw/rplidar",), ("orca/hw/rplidar/",), ("hw_framing", "geometry", "base")),
    Layer("hw_camera", ("src/hw/camera",), ("orca/hw/camera/",), ("hw_link", "base"), ("jpeg",)),
    Layer("camera_driver", ("src/hw/camera/driver",), (), ("hw_camera", "geometry_objects", *DEVICE), ("fmt",)),
    Layer("hw_xr4000", ("src/hw/xr4000",), ("orca/hw/xr4000/",), ("hw_framing", "geometry", "base")),
    Layer("xr4000_driver", ("src/hw/xr4000/driver",), (), ("hw_xr4000", *DRIVER), ("fmt",)),
    Layer("graph", (GRAPH,), ("orca/graph/",), ("xml", "base"), ("fmt",), module=GRAPH),
    Layer("graph_reading", (f"{GRAPH}/reading",), (), ("graph", "xml", "base"), ("fmt",), module=GRAPH),
    Layer("graph_checking", (f"{GRAPH}/checking",), (), ("graph_reading", "graph", "xml", "base"), ("fmt",), module=GRAPH),
    Layer("graph_showing", (f"{GRAPH}/showing",), (), ("graph_checking", "graph_reading", "graph", "xml", "base"), ("fmt",),
          module=GRAPH),
    Layer("plugin_inspection", (f"{PLUGIN}/inspection",), (), DEVICE, ("fmt",), module=PLUGIN),
    Layer("plugin", (PLUGIN,), ("orca/plugin/",), ("plugin_inspection", *DEVICE), ("fmt",), module=PLUGIN),
    Layer("log_replay", ("src/hw/log",), (), ("recording_objects", "recording", *DEVICE)),
    Layer("device", ("src/hw",), (), ("hw_link", "geometry_objects", *DEVICE), ("fmt",), siblings=False),
    Layer("avoidance", ("src/components/avoidance",), ("orca/avoidance/",),
          ("navigation", "geometry_objects", "geometry", *COMPONENT)),
    Layer("goals", ("src/components/goals",), ("orca/goals/",), ("geometry_objects", "geometry", *COMPONENT)),
    Layer("planning", ("src/components/planning",), ("orca/planning/",), ("navigation", "xml", "geometry_objects", "geometry", *COMPONENT)),
    Layer("components", ("src/components",), (), ("avoidance", "collision", "goals", "planning", "hw_player", "image", "navigation", "tracking", "robot_file", "geometry_objects", *DEVICE), ("eigen", "fmt"),
          siblings=False),
    Layer("map_server", ("src/components/map_server",), (), ("maps", "sim_files", *SIM_FILES, *COMPONENT)),  # draws worlds
    Layer("task_tree", ("src/components/task_tree",), (), ("goals", "geometry_objects", "geometry", "text", "xml", *COMPONENT)),
    Layer("sim_model", ("sim/model",), tuple(f"orca/sim/{name}.hpp" for name in (
        "event", "figures", "floor", "gripper_order", "mesh", "occupancy", "readings", "realism", "robot_model", "scaled_errors", "sections", "shape", "snapshot", "walker", "world_model")),
          SIM_MODEL, ("eigen", "fmt"), module="sim"),
    Layer("sim_rays", ("sim/rays",), ("orca/sim/caster.hpp",), SIM_RAYS, ("eigen", "fmt"), module="sim"),
    Layer("sim_generators", ("sim/generators",), ("orca/sim/generate.hpp",), SIM_RAYS, ("fmt",), module="sim"),
    Layer("sim_sensors", ("sim/sensors",), (), SIM_SENSORS, ("eigen", "fmt"), module="sim"),
    Layer("sim_motion", ("sim/motion",), (), SIM_MOTION, ("bullet", "eigen", "fmt"), module="sim"),
    Layer("sim_world", ("sim/world",), ("orca/sim/stand.hpp", "orca/sim/world.hpp"), ("collision", *SIM_WORLD), ("eigen", "fmt"), module="sim"),
    Layer("sim_files", ("sim/files",), ("orca/sim/bitmap.hpp", "orca/sim/robot_file.hpp", "orca/sim/world_file.hpp"),
          SIM_FILES, ("urdfdom", "zlib", "bullet", "eigen", "fmt"), module="sim"),  # Bullet: transforms
    Layer("emulators", ("sim/emulators",), ("orca/emulators/",), ("hw_framing", "geometry", "base")),
    Layer("sim_plugin", ("sim/plugin",), (), ("geometry_objects", "sim_files", *SIM_FILES, *DEVICE), ("fmt",)),
    Layer("sim_emulated", ("sim/emulated",), (), ("emulators", "sim_plugin", "hw_link", "sim_files", *SIM_FILES, *DEVICE), ("fmt",)),
    Layer("host_containment", (f"{HOST}/containment",), ("orca/host/alarm.hpp", "orca/host/alarm_store.hpp", "orca/host/last_words.hpp",
                                                                "orca/host/stop_signal.hpp"),
          ("plugin", *DEVICE), ("fmt",), module=HOST),
    Layer("host_picture", (f"{HOST}/picture",), ("orca/host/picture.hpp",), DEVICE, ("cairo", "fmt"), module=HOST),
    Layer("host", (HOST,), ("orca/host/",), ("host_picture", "host_containment", "plugin", "graph", "hw_api",
          "component_api", "patterns_endpoints", "idl", "base"), module=HOST),
    Layer("host_recording", (f"{HOST}/run/recording",), ("orca/host/port_taps.hpp",), ("recording_objects", "recording", "host", "graph",
          "patterns_endpoints", "text", "idl", "base"), module=HOST),
    Layer("host_reporting", (f"{HOST}/run/reporting",), (), ("host_recording", "host", "host_containment", "plugin",
          "hw_api", "patterns_endpoints", "idl", "base"), module=HOST),
    Layer("host_component_parts", (f"{HOST}/run/component/parts",), (), ("host_reporting", "host", "host_containment",
          "plugin", "component_api", "patterns_endpoints", "patterns", "base"), module=HOST),
    Layer("host_component_state", (f"{HOST}/run/component/state",), (), ("host_component_parts", "host", "base"),
          module=HOST),
    Layer("host_component", (f"{HOST}/run/component",), (), ("host_component_state", "host_component_parts", "host",
          "base"), module=HOST),
    Layer("host_hardware", (f"{HOST}/run/hardware",), (), ("host_reporting", "host", "host_containment", "plugin", "hw_api",
          "base"), module=HOST),
    Layer("host_system", (f"{HOST}/run/system",), (), ("host_hardware", "host_component", "host_reporting",
          "host_recording", "host", "host_containment", "graph", "hw_api", "patterns_dds", "patterns_local", "patterns_endpoints", "base"),
          module=HOST),
    Layer("host_trial", (f"{HOST}/run/trial",), (), ("host_system", "host_component", "host_reporting", "host_recording",
          "host", "host_containment", "plugin", "graph", "patterns_local", "patterns_endpoints", "idl", "base"),
          module=HOST),
    Layer("host_swap", (f"{HOST}/run/swap",), ("orca/host/swap.hpp", "orca/host/timed_change.hpp"), ("host_trial",
          "host_system", "host_hardware", "host_component", "host_component_parts", "host_reporting", "host",
          "host_containment", "plugin", "graph", "hw_api", "patterns_local", "xml", "base"), module=HOST),
    Layer("host_part", (f"{HOST}/run/part",), ("orca/host/fitting.hpp", "orca/host/hosted_part.hpp", "orca/host/part_access.hpp", "orca/host/shadow.hpp"), ("host_swap",
          "host_trial", "host_system", "host_reporting", "host_recording", "host", "host_containment", "plugin", "graph",
          "patterns_dds", "patterns_shm", "patterns_endpoints", "idl", "base"), module=HOST),
    Layer("host_judging", (f"{HOST}/run/judging",), ("orca/host/edge_choice.hpp", "orca/host/idleness.hpp",
          "orca/host/conclusion.hpp", "orca/host/robot_finder.hpp"), ("host", "graph", "base"), module=HOST),
    Layer("host_run", (f"{HOST}/run",), ("orca/host/run_system.hpp",), ("ros", "host_judging", "host_part", "host_swap", "host_trial",
          "host_system", "host_recording", "host", "host_containment", "plugin", "graph", "hw_link", "base"), module=HOST),
    Layer("supervisor_channel", (f"{SUPERVISOR}/channel",), ("orca/supervisor/channel.hpp", "orca/supervisor/control.hpp",
          "orca/supervisor/message.hpp", "orca/supervisor/record.hpp", "orca/supervisor/role.hpp", "orca/supervisor/vocabulary.hpp"), ("graph", "base"),
          module=SUPERVISOR),
    Layer("supervisor_processes", (f"{SUPERVISOR}/processes",), ("orca/supervisor/",), ("supervisor_channel", "graph", "base"),
          module=SUPERVISOR),
    Layer("supervisor_bulletin", (f"{SUPERVISOR}/bulletin",), ("orca/supervisor/bulletin.hpp",), ("dds_security", "keys", "idl", "base"), ("fastdds",),
          module=f"{SUPERVISOR}/bulletin"),
    Layer("supervisor_agreed", (f"{SUPERVISOR}/agreed",), ("orca/supervisor/system_facts.hpp",
          "orca/supervisor/supervised_options.hpp"), ("supervisor_processes", "supervisor_channel", "host", "graph",
          "base"), module=SUPERVISOR),
    Layer("supervisor_hosted", (f"{SUPERVISOR}/hosted",), ("orca/supervisor/host_process_main.hpp",), ("supervisor_agreed",
          "supervisor_bulletin", "supervisor_processes", "supervisor_channel", "host_part", "host_swap", "host",
          "host_containment", "plugin", "graph", "idl", "base"), module=SUPERVISOR),
    Layer("supervisor_members", (f"{SUPERVISOR}/members",), (), ("supervisor_agreed", "supervisor_processes",
          "supervisor_channel", "host_judging", "host", "host_containment", "graph", "idl", "base"), module=SUPERVISOR),
    Layer("supervisor_control", (f"{SUPERVISOR}/control",), (), ("supervisor_members", "supervisor_agreed",
          "supervisor_processes", "supervisor_channel", "host_part", "host", "host_containment", "plugin", "graph", "xml",
          "idl", "base"), module=SUPERVISOR),
    Layer("supervisor_machines", (f"{SUPERVISOR}/machines",), (), ("supervisor_control", "supervisor_members",
          "supervisor_processes", "supervisor_channel", "host_judging", "host", "graph", "xml", "idl", "base"),
          module=SUPERVISOR),
    Layer("supervisor_starting", (f"{SUPERVISOR}/starting",), ("orca/supervisor/outputs.hpp",), ("supervisor_members",
          "supervisor_agreed", "supervisor_processes", "supervisor_channel", "host", "graph", "patterns_shm", "base"),
          module=SUPERVISOR),
    Layer("supervisor_applying", (f"{SUPERVISOR}/applying",), (), ("supervisor_starting", "supervisor_control",
          "supervisor_members", "supervisor_agreed", "supervisor_processes", "supervisor_channel", "graph", "patterns_shm",
          "xml", "base"), module=SUPERVISOR),
    Layer("supervisor_run", (f"{SUPERVISOR}/run",), ("orca/supervisor/supervised_run.hpp",), ("supervisor_applying",
          "supervisor_starting", "supervisor_machines", "supervisor_control", "supervisor_members", "supervisor_agreed",
          "supervisor_processes", "host_judging", "host", "host_containment", "graph", "base"), module=SUPERVISOR),
    Layer("supervisor_attending", (f"{SUPERVISOR}/attending",), ("orca/supervisor/attendance.hpp",), ("supervisor_run",
          "supervisor_starting", "supervisor_hosted", "supervisor_members", "supervisor_agreed", "supervisor_processes",
          "supervisor_channel", "host_part", "host", "graph", "base"), module=SUPERVISOR),
    Layer("batch_statistics", (f"{BATCH}/statistics",), ("orca/batch/statistics/",), ("base",)),
    Layer("batch_measures", (f"{BATCH}/measures",), ("orca/batch/localization.hpp", "orca/batch/measures.hpp", "orca/batch/referee.hpp"), ("batch_statistics",
          "hw_api", "geometry", "xml", "base"), module=BATCH),
    Layer("batch_results", (f"{BATCH}/results",), ("orca/batch/record.hpp", "orca/batch/store.hpp",
          "orca/batch/lap_times.hpp"), ("batch_measures", "xml", "base"), ("sqlite",), module=BATCH),
    Layer("batch_experiment", (f"{BATCH}/experiment",), ("orca/batch/experiment.hpp",), ("batch_results",
          "batch_measures", "batch_statistics", "geometry", "xml", "base"), module=BATCH),
    Layer("batch_tuning", (f"{BATCH}/tuning",), ("orca/batch/tuning.hpp",), ("batch_experiment", "batch_results", "xml", "base"),
          module=BATCH),
    Layer("batch_report", (f"{BATCH}/report",), ("orca/batch/report.hpp",), ("batch_experiment", "batch_results",
          "batch_statistics", "geometry", "xml", "base"), ("cairo",), module=BATCH),
    Layer("batch_making", (f"{BATCH}/making",), ("orca/batch/one_run.hpp",), ("batch_experiment", "batch_results",
          "batch_measures", "host_run", "host", "graph", "idl", "base"), module=BATCH),
    Layer("batch_comparing", (f"{BATCH}/comparing",), ("orca/batch/difference.hpp", "orca/batch/results_difference.hpp"),
          ("batch_making", "batch_experiment", "batch_results", "xml", "base"), module=BATCH),
    Layer("batch_running", (f"{BATCH}/running",), ("orca/batch/batch.hpp", "orca/batch/missing_runs.hpp"),
          ("batch_comparing", "batch_making", "batch_experiment", "batch_results", "base"), module=BATCH),
    Layer("batch_checking", (f"{BATCH}/checking",), ("orca/batch/inputs.hpp",), ("batch_making", "batch_experiment",
          "batch_results", "batch_measures", "host", "graph", "hw_api", "xml", "base"), module=BATCH),
    Layer("testing", ("src/testing",), ("orca/testing/",), ("host_run", "host", "graph", "plugin", "xml", *DEVICE)),
    Layer("guest", ("src/apps/deployer/guest",), (), ("host_part", "host", "graph", "text", "xml", *DEVICE), module="src/apps"),
    Layer("apps", ("src/apps",), (), ("guest", "batch_checking", "batch_running", "batch_comparing", "batch_tuning", "batch_report",
          "batch_experiment", "batch_results", "batch_measures", "batch_statistics", "supervisor_attending",
          "supervisor_run", "supervisor_starting", "supervisor_hosted", "supervisor_agreed", "supervisor_processes", "supervisor_channel",
          "host_run", "host", "host_containment", "host_picture", "graph", "plugin", "navigation", "recording_objects", "recording",
          "robot_file", "geometry_objects", "keys", "patterns_dds", "ros", "maps", "text", "xml", "hw_link", *DEVICE), ("fmt",), module="src/apps"),
    Layer("view", ("src/apps/orcaview",), (), ("apps", "supervisor_processes", "supervisor_channel", "recording_objects", "recording", "robot_file", "ros", "keys", "text", "xml", *DEVICE),
          ("boost", "nlohmann", "openssl")),
)
graphlib.TopologicalSorter({layer.name: layer.may for layer in LAYERS}).prepare()  # raises CycleError for a circle

# Library -> prefixes of its headers. All layers may use headers that no line names (the standard library, POSIX).
LIBRARY_HEADERS = {
    "spdlog": ("spdlog/",),
    "fmt": ("fmt/",),
    "fastdds": ("fastdds/", "fastrtps/"),
    "fastcdr": ("fastcdr/",),
    "tinyxml2": ("tinyxml2.h",),
    "openssl": ("openssl/",),
    "eigen": ("Eigen/", "unsupported/Eigen/"),
    "fcl": ("fcl/", "ccd/"),
    "bullet": ("bullet/", "btBullet", "LinearMath/", "BulletCollision/", "BulletDynamics/", "BulletSoftBody/"),
    "urdfdom": ("urdf_parser/", "urdf_model/", "urdf_exception/", "urdf_world/", "urdf_sensor/"),
    "boost": ("boost/",),
    "nlohmann": ("nlohmann/",),
    "jpeg": ("jpeglib.h", "jerror.h"),
    "png": ("png.h", "libpng"),
    "yaml": ("yaml-cpp/",),
    "zlib": ("zlib.h",),
    "zstd": ("zstd.h",),
    "lz4": ("lz4frame.h",),
    "cairo": ("cairo",),
    "sqlite": ("sqlite3.h",),
    "catch2": ("catch2/",),
    "benchmark": ("benchmark/",),
}
