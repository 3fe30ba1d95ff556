// One model in MuJoCo's WebAssembly build, its numbers as arrays that can be read and written.

const MODEL = [
  "geom_solref", "geom_friction", "jnt_stiffness", "qpos_spring", "tendon_frictionloss",
  "tendon_num", "tendon_adr", "tendon_solref_fri", "tendon_solimp_fri", "wrap_objid", "wrap_prm",
  "jnt_dofadr", "dof_bodyid", "body_parentid",
];
const DATA = [
  "qpos", "qvel", "qfrc_applied", "geom_xpos", "ten_length", "ten_velocity", "xpos", "xmat",
  "cdof", "cvel", "subtree_com",
];

export class Physics {
  // `mjcf` rounds to six digits; `exact` holds the arrays that it rounds, see data.py
  constructor(mujoco, { mjcf, exact }) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(mjcf);
    this.data = new mujoco.MjData(this.model);
    for (const [name, numbers] of Object.entries(exact)) this.model[name].set(numbers);
    this.nv = this.model.nv;
    this.timestep = this.model.opt.timestep;
    this.look();
    mujoco.mj_forward(this.model, this.data);
  }

  // take the arrays anew: when WebAssembly's memory grows the old ones have no length
  look() {
    for (const name of MODEL) this[name] = this.model[name];
    for (const name of DATA) this[name] = this.data[name];
  }

  lookIfMoved() {
    if (this.qpos.length === 0) this.look();
  }

  step() {
    this.mujoco.mj_step(this.model, this.data);
    this.lookIfMoved();
  }


  // geoms that touch the ground, and the normal force on each [N]
  touching() {
    const force = this.data.efc_force, contacts = this.data.contact, found = [];
    for (let i = 0, count = contacts.size(); i < count; i++) {
      const contact = contacts.get(i);
      if (contact.efc_address >= 0) found.push([contact.geom2, force[contact.efc_address]]);
      contact.delete(); // what the binding hands out is not collected
    }
    contacts.delete();
    return found;
  }

  delete() {
    this.data.delete();
    this.model.delete();
  }
}
